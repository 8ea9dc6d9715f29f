#include "app/tables/sky_table.h"

#include <fmt/ostream.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "render/base/angles.h"
#include "render/sky/hemisphere.h"
#include "render/sun/spectrum.h"

namespace app {
namespace {

struct Row {
  double azimuth_deg;
  double elevation_deg;
  glm::dvec3 color;
  double sun_angle_deg;
};

// Lux on level ground.
struct Level {
  double diffuse;
  double direct;
  glm::dvec3 diffuse_rgb;
};

std::array<const char*, 3> names_of(ColorSpace space) {
  if (space == ColorSpace::Xyz) return {"X", "Y", "Z"};
  if (space == ColorSpace::Yxy) return {"Y", "x", "y"};
  return {"r", "g", "b"};
}

glm::dvec3 color_of(const render::SkyModel& sky, const glm::dvec3& view, ColorSpace space) {
  if (space == ColorSpace::Rgb) return sky.luminance_rgb(view);
  const glm::dvec3 xyz = sky.luminance_xyz(view);
  if (space == ColorSpace::Xyz) return xyz;
  const double sum = xyz.x + xyz.y + xyz.z;
  return sum > 0.0 ? glm::dvec3(xyz.y, xyz.x / sum, xyz.y / sum) : glm::dvec3(0.0);
}

Row row_of(const render::Daylight& answer, const ViewRequest& view, ColorSpace space) {
  const glm::dvec3 direction = view_direction(view);
  return {view.azimuth_rad * render::kDegPerRad, view.elevation_rad * render::kDegPerRad,
          color_of(*answer.sky, direction, space), sun_angle_rad(answer, direction) * render::kDegPerRad};
}

Level level_of(const render::Daylight& answer) {
  const glm::dvec3 diffuse = render::horizontal_illuminance(*answer.sky);
  const double sine = std::max(std::sin(answer.sun.apparent_elevation_rad), 0.0);
  return {render::luminance(diffuse), render::luminance(answer.sun_illuminance_rgb) * sine, diffuse};
}

}  // namespace

void write_sky_text(std::ostream& out, const render::Daylight& answer, const std::vector<ViewRequest>& views,
                    ColorSpace space) {
  const Level level = level_of(answer);
  fmt::print(out,
             "sun                 azimuth {:.4f} deg, elevation {:.4f} deg ({:.4f} apparent)\n"
             "level ground gets   {:.6g} lux: {:.6g} from the sky, {:.6g} from the sun\n",
             answer.sun.azimuth_rad * render::kDegPerRad, answer.sun.elevation_rad * render::kDegPerRad,
             answer.sun.apparent_elevation_rad * render::kDegPerRad, level.diffuse + level.direct, level.diffuse,
             level.direct);
  if (views.empty()) return;
  const auto names = names_of(space);
  fmt::print(out, "{:>10} {:>10} {:>12} {:>12} {:>12} {:>10}\n", "azimuth", "elevation", names[0], names[1], names[2],
             "from sun");
  for (const ViewRequest& view : views) {
    const Row row = row_of(answer, view, space);
    fmt::print(out, "{:>10.3f} {:>10.3f} {:>12.6g} {:>12.6g} {:>12.6g} {:>10.3f}\n", row.azimuth_deg, row.elevation_deg,
               row.color.x, row.color.y, row.color.z, row.sun_angle_deg);
  }
}

void write_sky_csv(std::ostream& out, const render::Daylight& answer, const std::vector<ViewRequest>& views,
                   ColorSpace space) {
  const auto names = names_of(space);
  fmt::print(out, "view_azimuth_deg,view_elevation_deg,{},{},{},sun_angle_deg\n", names[0], names[1], names[2]);
  for (const ViewRequest& view : views) {
    const Row row = row_of(answer, view, space);
    fmt::print(out, "{:.6g},{:.6g},{:.8g},{:.8g},{:.8g},{:.6f}\n", row.azimuth_deg, row.elevation_deg, row.color.x,
               row.color.y, row.color.z, row.sun_angle_deg);
  }
}

void write_sky_json(std::ostream& out, const render::Daylight& answer, const std::vector<ViewRequest>& views,
                    ColorSpace space) {
  const Level level = level_of(answer);
  const auto names = names_of(space);
  nlohmann::json json = {{"sun",
                          {{"azimuth_deg", answer.sun.azimuth_rad * render::kDegPerRad},
                           {"elevation_deg", answer.sun.elevation_rad * render::kDegPerRad},
                           {"apparent_elevation_deg", answer.sun.apparent_elevation_rad * render::kDegPerRad}}},
                         {"horizontal_illuminance_lux",
                          {{"global", level.diffuse + level.direct},
                           {"diffuse", level.diffuse},
                           {"direct", level.direct},
                           {"diffuse_rgb", {level.diffuse_rgb.r, level.diffuse_rgb.g, level.diffuse_rgb.b}}}},
                         {"directions", nlohmann::json::array()}};
  for (const ViewRequest& view : views) {
    const Row row = row_of(answer, view, space);
    json["directions"].push_back({{"view_azimuth_deg", row.azimuth_deg},
                                  {"view_elevation_deg", row.elevation_deg},
                                  {names[0], row.color.x},
                                  {names[1], row.color.y},
                                  {names[2], row.color.z},
                                  {"sun_angle_deg", row.sun_angle_deg}});
  }
  out << json.dump(2) << '\n';
}

}  // namespace app
