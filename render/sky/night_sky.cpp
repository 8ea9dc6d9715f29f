#include "render/sky/night_sky.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "render/sky/direction.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kAirglowLux = 8e-4;
constexpr double kLayerHeightRatio = 6371.0 / (6371.0 + 90.0);  // airglow shines at 90 km

// How much longer the path through the glowing layer is than straight up; 1.42 is its mean over the projected sky.
double van_rhijn(double sin_elevation) {
  constexpr double kMean = 1.42;
  const double cos2 = 1.0 - sin_elevation * sin_elevation;
  return 1.0 / std::sqrt(1.0 - kLayerHeightRatio * kLayerHeightRatio * cos2) / kMean;
}

// Stars and airglow together are a little warmer than daylight (Leinert et al. 1998).
glm::dvec3 glow_xyz() {
  return xyz_from_yxy(kAirglowLux / std::numbers::pi, 0.345, 0.355);
}

class NightSky final : public SkyModel {
 public:
  NightSky(std::unique_ptr<SkyModel> sky, std::unique_ptr<SkyModel> moonlit, double moon_share)
      : sky_(std::move(sky)), moonlit_(std::move(moonlit)), moon_share_(moon_share) {}

  glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const override {
    static const glm::dvec3 glow = rgb_from_xyz(glow_xyz());
    glm::dvec3 sum = sky_->luminance_rgb(direction_in_world) + glow * van_rhijn(above_horizon(direction_in_world).z);
    if (moonlit_) sum += moon_share_ * moonlit_->luminance_rgb(direction_in_world);
    return sum;
  }

  glm::dvec3 luminance_xyz(const glm::dvec3& direction_in_world) const override {
    glm::dvec3 sum =
        sky_->luminance_xyz(direction_in_world) + glow_xyz() * van_rhijn(above_horizon(direction_in_world).z);
    if (moonlit_) sum += moon_share_ * moonlit_->luminance_xyz(direction_in_world);
    return sum;
  }

 private:
  std::unique_ptr<SkyModel> sky_;
  std::unique_ptr<SkyModel> moonlit_;
  double moon_share_;
};

}  // namespace

std::unique_ptr<SkyModel> make_night_sky(std::unique_ptr<SkyModel> sky, std::unique_ptr<SkyModel> moonlit,
                                         double moon_share) {
  return std::make_unique<NightSky>(std::move(sky), std::move(moonlit), moon_share);
}

}  // namespace render
