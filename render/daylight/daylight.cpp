#include "render/daylight/daylight.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

#include "render/sky/moon.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

SunPosition sun_of(const DaylightRequest& request) {
  SunPosition sun;
  if (request.place && request.time) sun = sun_position(*request.place, *request.time, request.tier, request.weather);
  if (request.sun.azimuth_rad) sun.azimuth_rad = *request.sun.azimuth_rad;
  if (request.sun.elevation_rad) sun.elevation_rad = sun.apparent_elevation_rad = *request.sun.elevation_rad;
  return sun;
}

SkyOptions sky_options_of(const DaylightRequest& request) {
  SkyOptions options = request.sky;
  if (request.place) options.height_m = request.place->height_m;
  if (!request.time) return options;
  const auto midnight = std::chrono::floor<std::chrono::days>(*request.time);
  options.clouds.time_s = std::chrono::duration<double>(*request.time - midnight).count();
  if (request.place) options.moon = moon_position(*request.place, *request.time, request.weather);
  return options;
}

// By measured or given conditions where there are any, coloured and dimmed at the horizon as by the air's turbidity.
glm::dvec3 natural_illuminance_rgb(const SkyOptions& options, const SunPosition& sun, const SunLight& by_air) {
  const std::optional<double> given_lux = options.model == "perez" ? given_sun_lux(options, sun) : std::nullopt;
  const double lux = luminance(by_air.illuminance_rgb);
  if (!given_lux || lux <= 0.0) return by_air.illuminance_rgb;
  return by_air.illuminance_rgb * (*given_lux * by_air.visible_disc_fraction / lux);
}

// The four digits of Rec. 709 itself; luminance() has those of its matrix.
const glm::dvec3 kRec709{0.2126, 0.7152, 0.0722};

glm::dvec3 illuminance_rgb_of(const GivenSun& given, const glm::dvec3& natural) {
  if (!given.illuminance_lux && !given.color_rgb) return natural;
  const double lux = given.illuminance_lux.value_or(glm::dot(natural, kRec709));
  const glm::dvec3 color = given.color_rgb.value_or(glm::dvec3(1.0));
  return color * (lux / glm::dot(color, kRec709));
}

// Once the sun is down, the moon casts the shadows.
std::optional<DirectLight> moonlight(const DaylightRequest& request, const SkyOptions& options,
                                     const DirectLight& sunlight) {
  const bool dark = sunlight.illuminance_rgb == glm::dvec3(0.0);
  if (!dark || !options.moon || request.sun.illuminance_lux) return std::nullopt;
  const glm::dvec3 moonlight = moon_illuminance_rgb(*options.moon, options.turbidity);
  if (moonlight == glm::dvec3(0.0)) return std::nullopt;
  return DirectLight{options.moon->apparent_direction_in_world(), moonlight, sunlight.angular_radius_rad, true};
}

}  // namespace

Daylight daylight(const DaylightRequest& request) {
  Daylight light;
  light.sun = sun_of(request);
  light.sky_options = sky_options_of(request);
  const SkyOptions& options = light.sky_options;
  const SunLight by_air = sun_light(light.sun, options.turbidity, options.height_m);
  DirectLight sunlight;
  sunlight.direction_in_world = light.sun.apparent_direction_in_world();
  sunlight.illuminance_rgb = illuminance_rgb_of(request.sun, natural_illuminance_rgb(options, light.sun, by_air));
  sunlight.angular_radius_rad = request.sun.angular_radius_rad.value_or(by_air.shadow_radius_rad);
  light.direct = moonlight(request, options, sunlight).value_or(sunlight);
  light.sky = make_sky(options, light.sun);
  light.direct.illuminance_rgb *= light.sky->transmittance(light.direct.direction_in_world);
  light.sun_illuminance_rgb = sunlight.illuminance_rgb * light.sky->transmittance(sunlight.direction_in_world);
  return light;
}

SkyLight sky_light(const Daylight& light, double ground_albedo) {
  const glm::dvec3 on_level_ground = light.direct.illuminance_rgb * std::max(0.0, light.direct.direction_in_world.z);
  return sky_light(*light.sky, on_level_ground, ground_albedo);
}

std::vector<std::string> beyond_range(const Daylight& light) {
  return beyond_range(light.sky_options, light.sun);
}

}  // namespace render
