#include "render/sky/twilight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace render {
namespace {

// log10 of the illuminance as a cubic of elevation / 90 degrees, from `floor_deg` upwards (Circular 171, table 1).
struct Piece {
  double floor_deg;
  double l0, l1, l2, l3;
};
constexpr std::array<Piece, 6> kPieces = {{{20.0, 3.74, 3.97, -4.07, 1.47},
                                           {5.0, 3.05, 13.28, -45.98, 64.33},
                                           {-0.8, 2.88, 22.26, -207.64, 1034.30},
                                           {-5.0, 2.88, 21.81, -258.11, -858.36},
                                           {-12.0, 2.70, 12.17, -431.69, -1899.83},
                                           {-18.0, 13.84, 262.72, 1447.42, 2797.93}}};

}  // namespace

double twilight_illuminance_lux(double sun_elevation_rad) {
  const double elevation_deg = std::clamp(sun_elevation_rad * 180.0 / std::numbers::pi, -18.0, 90.0);
  std::size_t i = 0;
  while (i + 1 < kPieces.size() && elevation_deg < kPieces[i].floor_deg) ++i;
  const Piece& p = kPieces[i];
  const double x = elevation_deg / 90.0;
  return std::pow(10.0, p.l0 + x * (p.l1 + x * (p.l2 + x * p.l3)));
}

}  // namespace render
