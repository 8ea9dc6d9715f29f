#include "app/process/scene_state_builder.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "app/error.h"
#include "ar/error.h"
#include "render/base/angles.h"

namespace app {
namespace {

const glm::dvec3 kRec709{0.2126, 0.7152, 0.0722};

render::Place to_render(const ar::GeoPosition& place) {
  return {place.latitude_deg / render::kDegPerRad, place.longitude_deg / render::kDegPerRad, place.height_m};
}

void check_sun_is_known(const render::GivenSun& sun, const Conditions& conditions) {
  if (sun.azimuth_rad || (conditions.place && conditions.time)) return;
  const char* missing = conditions.place ? "the time" : conditions.time ? "the place" : "place and time";
  throw UsageError(fmt::format(
      "{} of the picture are not known: neither the command line, nor the scene, nor the video's metadata tell\n"
      "give --at LAT,LON and --time 2024-06-21T07:30:00Z, or `place:` and `time:` in the scene, or `sun:` there",
      missing));
}

// A sun that the scene puts somewhere stands there in still air, and no moon comes up against it.
render::DaylightRequest daylight_request(const SceneSky& sky, const render::GivenSun& sun,
                                         const Conditions& conditions) {
  render::DaylightRequest request{.sun = sun, .sky = sky.options};
  if (conditions.place && sun.azimuth_rad) request.sky.height_m = conditions.place->height_m;
  if (conditions.place && !sun.azimuth_rad) request.place = to_render(*conditions.place);
  return request;
}

render::Instance to_instance(const SceneInstance& placed) {
  render::Instance instance;
  instance.name = placed.name;
  instance.model = placed.model;
  instance.world_from_model = render::place_model(placed.position_in_world, placed.heading_rad, placed.scale);
  instance.real = placed.real;
  return instance;
}

}  // namespace

SceneStateBuilder::SceneStateBuilder(const SceneFile& scene, const Conditions& conditions)
    : sky_(scene.sky), sun_(scene.sun), conditions_(conditions), exposure_(scene.exposure) {
  check_sun_is_known(sun_, conditions_);
  for (const SceneInstance& instance : scene.instances) state_.instances.push_back(to_instance(instance));
  state_.medium = scene.medium;
  light(0);
  state_.exposure = exposure_.value_or(state_.exposure);
}

void SceneStateBuilder::light(std::int64_t second) {
  if (second_ == second) return;
  const bool first = !second_;
  second_ = second;
  render::DaylightRequest request = daylight_request(sky_, sun_, conditions_);
  if (conditions_.time) request.time = *conditions_.time + std::chrono::seconds(second);
  const render::Daylight daylight = daylight_or_input_error(request);
  if (first) {
    for (const std::string& message : render::beyond_range(daylight)) spdlog::warn(message);
  }
  const render::DirectLight& direct = daylight.direct;
  ensure_sun(state_) = {direct.direction_in_world, direct.illuminance_rgb, direct.angular_radius_rad, direct.is_moon};
  const bool dark = daylight.sky_options.model == "none";
  state_.sky = dark ? nullptr : daylight.sky;
  state_.sky_light = dark ? render::SkyLight{} : render::sky_light(daylight, sky_.ground_albedo);
}

render::Daylight SceneStateBuilder::daylight_or_input_error(const render::DaylightRequest& request) const {
  try {
    return render::daylight(request);
  } catch (const std::runtime_error& error) {
    throw ar::InputError(sky_.where + ": " + error.what());
  }
}

render::SceneState SceneStateBuilder::at(double elapsed_s) {
  // A sun that the scene fixes does not move.
  if (!sun_.azimuth_rad) light(static_cast<std::int64_t>(std::floor(elapsed_s)));
  return state_;
}

double horizontal_illuminance(const render::SceneState& state) {
  const double sine = std::max(0.0, sun_of(state).direction_in_world.z);
  return glm::dot(sun_of(state).illuminance_rgb * sine + state.sky_light.horizontal_illuminance_rgb, kRec709);
}

void log_light(const render::SceneState& state) {
  const glm::dvec3& direction = sun_of(state).direction_in_world;
  const double azimuth_deg = render::kDegPerRad * std::atan2(direction.x, direction.y);
  spdlog::info("{} at azimuth {:.2f}, elevation {:.2f} degrees, {:.5g} lux; sky {:.5g} lux on level ground",
               sun_of(state).is_moon ? "moon" : "sun", azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg,
               render::kDegPerRad * std::asin(std::clamp(direction.z, -1.0, 1.0)),
               glm::dot(sun_of(state).illuminance_rgb, kRec709),
               glm::dot(state.sky_light.horizontal_illuminance_rgb, kRec709));
}

render::Camera camera_of_view(const SceneView& view, int width, int height) {
  const glm::dvec3 forward = glm::normalize(view.target_in_world - view.eye_in_world);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, view.up_in_world));
  const glm::dvec3 down = glm::cross(forward, right);
  render::Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fy = 0.5 * height / std::tan(0.5 * view.vertical_fov_rad);
  camera.fx = camera.fy;
  camera.cx = 0.5 * width;
  camera.cy = 0.5 * height;
  camera.world_from_camera = glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(down, 0.0), glm::dvec4(forward, 0.0),
                                        glm::dvec4(view.eye_in_world, 1.0));
  return camera;
}

}  // namespace app
