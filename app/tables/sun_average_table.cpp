#include "app/tables/sun_average_table.h"

#include <fmt/ostream.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "ar/place/place.h"
#include "render/base/angles.h"
#include "render/sun/spectrum.h"

namespace app {
namespace {

using render::AverageLight;
using render::DirectionBin;

double plane_lux(const DirectionBin& bin) {
  return bin.plane_sky_lux + bin.plane_sun_lux;
}

nlohmann::json rgb_json(const glm::dvec3& rgb) {
  return {rgb.r, rgb.g, rgb.b};
}

nlohmann::json bin_json(const DirectionBin& bin) {
  return {{"azimuth_deg", bin.azimuth_rad * render::kDegPerRad},
          {"elevation_deg", bin.elevation_rad * render::kDegPerRad},
          {"solid_angle_sr", bin.solid_angle_sr},
          {"sky_luminance_rgb", rgb_json(bin.sky_luminance_rgb)},
          {"sun_illuminance_rgb", rgb_json(bin.sun_illuminance_rgb)},
          {"plane_sky_lux", bin.plane_sky_lux},
          {"plane_sun_lux", bin.plane_sun_lux}};
}

}  // namespace

void write_average_text(std::ostream& out, const AverageLight& light) {
  const double sky = render::luminance(light.sky_illuminance_rgb);
  const double sun = render::luminance(light.sun_illuminance_rgb);
  fmt::print(out,
             "time                {} to {}, {} instants\n"
             "plane               faces azimuth {:.4g} deg, leans {:.4g} deg from level\n"
             "mean illuminance    {:.6g} lux: {:.6g} from the sky, {:.6g} from the sun\n"
             "exposure            {:.6g} klx h\n\n"
             "{:>10} {:>10} {:>14} {:>14} {:>14} {:>8}\n",
             ar::format_time(light.request.first), ar::format_time(light.request.last), light.instants,
             light.request.plane.azimuth_rad * render::kDegPerRad, light.request.plane.tilt_rad * render::kDegPerRad,
             sky + sun, sky, sun, (sky + sun) * light.hours * 1e-3, "azimuth", "elevation", "sky, cd/m2", "sun, lux",
             "on plane, lux", "share");
  constexpr std::ptrdiff_t kShown = 10;
  std::vector<DirectionBin> bins = light.bins;
  const auto shown = bins.begin() + std::min<std::ptrdiff_t>(kShown, std::ssize(bins));
  std::partial_sort(bins.begin(), shown, bins.end(),
                    [](const DirectionBin& a, const DirectionBin& b) { return plane_lux(a) > plane_lux(b); });
  std::for_each(bins.begin(), shown, [&](const DirectionBin& bin) {
    fmt::print(out, "{:>10.4g} {:>10.4g} {:>14.6g} {:>14.6g} {:>14.6g} {:>6.1f} %\n",
               bin.azimuth_rad * render::kDegPerRad, bin.elevation_rad * render::kDegPerRad,
               render::luminance(bin.sky_luminance_rgb), render::luminance(bin.sun_illuminance_rgb), plane_lux(bin),
               sky + sun > 0.0 ? 100.0 * plane_lux(bin) / (sky + sun) : 0.0);
  });
}

void write_average_csv(std::ostream& out, const AverageLight& light) {
  out << "azimuth_deg,elevation_deg,solid_angle_sr,sky_r,sky_g,sky_b,sun_r,sun_g,sun_b,plane_sky_lux,plane_sun_lux\n";
  for (const DirectionBin& bin : light.bins) {
    const glm::dvec3& sky = bin.sky_luminance_rgb;
    const glm::dvec3& sun = bin.sun_illuminance_rgb;
    fmt::print(out, "{:.6g},{:.6g},{:.8g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.8g},{:.8g}\n",
               bin.azimuth_rad * render::kDegPerRad, bin.elevation_rad * render::kDegPerRad, bin.solid_angle_sr, sky.r,
               sky.g, sky.b, sun.r, sun.g, sun.b, bin.plane_sky_lux, bin.plane_sun_lux);
  }
}

void write_average_json(std::ostream& out, const AverageLight& light) {
  nlohmann::json json = {{"from", ar::format_time(light.request.first)},
                         {"until", ar::format_time(light.request.last)},
                         {"instants", light.instants},
                         {"hours", light.hours},
                         {"plane",
                          {{"azimuth_deg", light.request.plane.azimuth_rad * render::kDegPerRad},
                           {"tilt_deg", light.request.plane.tilt_rad * render::kDegPerRad}}},
                         {"mean_illuminance_lux",
                          {{"sky", render::luminance(light.sky_illuminance_rgb)},
                           {"sun", render::luminance(light.sun_illuminance_rgb)},
                           {"sky_rgb", rgb_json(light.sky_illuminance_rgb)},
                           {"sun_rgb", rgb_json(light.sun_illuminance_rgb)}}},
                         {"bins", nlohmann::json::array()}};
  for (const DirectionBin& bin : light.bins) json["bins"].push_back(bin_json(bin));
  out << json.dump(2) << '\n';
}

}  // namespace app
