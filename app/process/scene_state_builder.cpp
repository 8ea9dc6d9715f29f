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
#include "render/sky/moon.h"
#include "render/sky/sky_light.h"
#include "render/sky/sky_model.h"
#include "render/sun/sun.h"

namespace app {
namespace {

const glm::dvec3 kRec709{0.2126, 0.7152, 0.0722};

render::Place to_render(const ar::GeoPosition& place) {
  return {place.latitude_deg / render::kDegPerRad, place.longitude_deg / render::kDegPerRad, place.height_m};
}

void check_sun_is_known(const SceneSun& sun, const Conditions& conditions) {
  if (sun.azimuth_rad || (conditions.place && conditions.time)) return;
  const char* missing = conditions.place ? "the time" : conditions.time ? "the place" : "place and time";
  throw UsageError(fmt::format(
      "{} of the picture are not known: neither the command line, nor the scene, nor the video's metadata tell\n"
      "give --at LAT,LON and --time 2024-06-21T07:30:00Z, or `place:` and `time:` in the scene, or `sun:` there",
      missing));
}

std::shared_ptr<const render::SkyModel> sky_for(const SceneSky& sky, const render::SkyOptions& options,
                                                const render::SunPosition& sun) {
  if (options.model == "none") return nullptr;
  try {
    return render::make_sky(options, sun);
  } catch (const std::runtime_error& error) {
    throw ar::InputError(sky.where + ": " + error.what());
  }
}

glm::dvec3 sun_illuminance_rgb(const SceneSun& sun, const glm::dvec3& natural) {
  const double lux = sun.illuminance_lux.value_or(glm::dot(natural, kRec709));
  if (sun.has_color || sun.illuminance_lux) return sun.color * (lux / glm::dot(sun.color, kRec709));
  return natural;
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
  for (const std::string& message : render::beyond_range(sky_options(0), sun_at(0))) spdlog::warn(message);
  state_.exposure = exposure_.value_or(state_.exposure);
}

render::SunPosition SceneStateBuilder::sun_at(std::int64_t second) const {
  if (sun_.azimuth_rad) {
    render::SunPosition sun;
    sun.azimuth_rad = *sun_.azimuth_rad;
    sun.elevation_rad = *sun_.elevation_rad;
    sun.apparent_elevation_rad = *sun_.elevation_rad;
    return sun;
  }
  return render::sun_position(to_render(*conditions_.place), *conditions_.time + std::chrono::seconds(second));
}

// The scene's sky at that second: clouds drift with the time of day, the moon stands where place and time put it.
render::SkyOptions SceneStateBuilder::sky_options(std::int64_t second) const {
  render::SkyOptions options = sky_.options;
  if (conditions_.place) options.height_m = conditions_.place->height_m;
  if (!conditions_.time) return options;
  const render::UtcTime now = *conditions_.time + std::chrono::seconds(second);
  const auto midnight = std::chrono::floor<std::chrono::days>(now);
  options.clouds.time_s = std::chrono::duration<double>(now - midnight).count();
  if (conditions_.place && !sun_.azimuth_rad) {
    options.moon = render::moon_position(to_render(*conditions_.place), now);
  }
  return options;
}

void SceneStateBuilder::light(std::int64_t second) {
  if (second_ == second) return;
  second_ = second;
  const render::SunPosition sun = sun_at(second);
  render::Sun& light = ensure_sun(state_);
  light.direction_in_world = sun.apparent_direction_in_world();
  const render::SkyOptions options = sky_options(second);
  const render::SunLight natural = render::sun_light(sun, options.turbidity, options.height_m);
  light.illuminance_rgb = sun_illuminance_rgb(sun_, natural.illuminance_rgb);
  light.angular_radius_rad = sun_.angular_radius_rad.value_or(natural.shadow_radius_rad);
  state_.sky = sky_for(sky_, options, sun);
  light.is_moon = false;
  if (options.moon && !sun_.illuminance_lux && light.illuminance_rgb == glm::dvec3(0.0)) {
    // Once the sun is down, the moon casts the shadows.
    const glm::dvec3 moonlight = render::moon_illuminance_rgb(*options.moon, options.turbidity);
    if (moonlight != glm::dvec3(0.0)) {
      light = {options.moon->apparent_direction_in_world(), moonlight, light.angular_radius_rad, true};
    }
  }
  if (state_.sky) light.illuminance_rgb *= state_.sky->transmittance(light.direction_in_world);
  const glm::dvec3 on_level_ground = light.illuminance_rgb * std::max(0.0, light.direction_in_world.z);
  state_.sky_light =
      state_.sky ? render::sky_light(*state_.sky, on_level_ground, sky_.ground_albedo) : render::SkyLight{};
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
