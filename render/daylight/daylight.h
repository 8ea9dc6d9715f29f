#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/sky/sky_light.h"
#include "render/sky/sky_model.h"
#include "render/sun/sun.h"

namespace render {

// What is given of the sun instead of what place, time and the air say.
struct GivenSun {
  std::optional<double> azimuth_rad = std::nullopt;
  std::optional<double> elevation_rad = std::nullopt;    // geometric and apparent
  std::optional<double> illuminance_lux = std::nullopt;  // facing the sun, before the clouds; keeps the moon dark, too
  std::optional<glm::dvec3> color_rgb = std::nullopt;    // relative, linear, its luminance above 0; the level stays
  std::optional<double> angular_radius_rad = std::nullopt;  // of the disc that casts penumbrae
};

// Where, when and in what air.
struct DaylightRequest {
  // Both: sun and moon stand where they do there and then. The place alone gives the height, the time alone the clouds'
  // drift; then GivenSun says where the sun stands, and there is no moon.
  std::optional<Place> place = std::nullopt;
  std::optional<UtcTime> time = std::nullopt;
  GivenSun sun = {};
  SunTier tier = SunTier::Precise;
  Weather weather = {};
  SkyOptions sky = {};  // height, moon and the clouds' time of day are put in as far as place and time are known
};

// The light that casts shadows: the sun's, or the moon's once no sunlight is left.
struct DirectLight {
  glm::dvec3 direction_in_world{0.0, 0.0, 1.0};  // unit, towards it, as it is seen through the air
  glm::dvec3 illuminance_rgb{0.0};               // lux on a plane that faces it, after the clouds
  double angular_radius_rad = 0.0;
  bool is_moon = false;
};

// Sun, moon and sky of one instant.
struct Daylight {
  SunPosition sun;
  SkyOptions sky_options;               // with all that place and time put in
  glm::dvec3 sun_illuminance_rgb{0.0};  // lux on a plane that faces the sun, after the clouds, whatever the moon does
  DirectLight direct;
  std::shared_ptr<const SkyModel> sky;  // never null: black for `none`
};

// Throws std::runtime_error where the sky cannot be made (see make_sky()).
Daylight daylight(const DaylightRequest& request);

// The sky boiled down to what lighting needs, over ground of that albedo under direct light and sky.
SkyLight sky_light(const Daylight& light, double ground_albedo);

// What of the request lies outside the sky model's range, and what is done instead: a sentence each.
std::vector<std::string> beyond_range(const Daylight& light);

}  // namespace render
