#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/sky/moon.h"
#include "render/sky/perez.h"
#include "render/sun/sun.h"

namespace render {

// The sky's light at one instant, without the sun's disc.
class SkyModel {
 public:
  virtual ~SkyModel() = default;

  // Luminance in cd/m2 as linear Rec. 709 seen in `direction_in_world` (unit vector, any length is normalised).
  // Below the horizon: what the model says of the ground, by default the horizon's own value. Never negative or NaN.
  virtual glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const = 0;

  // The same as CIE XYZ (Y in cd/m2), with what chromaticity the model has even where no Rec. 709 colour matches it.
  virtual glm::dvec3 luminance_xyz(const glm::dvec3& direction_in_world) const;

  // Share in [0, 1] of the light from beyond the air (sun, moon) in that direction that clouds let through: multiply
  // sun_light() by it. 1 where the model has no clouds.
  virtual double transmittance(const glm::dvec3& direction_in_world) const {
    (void)direction_in_world;
    return 1.0;
  }
};

// Sky condition for the Perez model instead of a turbidity: what pyranometers read, or the model's own parameters.
struct SkyIrradiance {
  double dni_wm2 = 0.0;
  double dhi_wm2 = 0.0;
};
struct SkyCondition {
  double clearness = 1.0;   // epsilon
  double brightness = 0.2;  // delta
};

// Clouds before the sky.
struct CloudOptions {
  std::string preset = "clear";  // clear, light, cloudy, overcast, night
  double time_s = 0.0;           // since an epoch of the caller's choice: clouds drift and change with it
  std::uint32_t seed = 1;
};

// What is asked of a sky; see the scene file's `sky`.
struct SkyOptions {
  // perez; preetham (as published, 2.3 times too bright), preetham:rescaled; cie:1 ... cie:15; scattering; reference;
  // image:FILE; none
  std::string model = "perez";
  double turbidity = kClearTurbidity;  // Linke's
  PerezBins bins = PerezBins::Interpolated;
  std::optional<SkyIrradiance> irradiance = std::nullopt;  // perez only
  CloudOptions clouds = {};
  std::optional<MoonPosition> moon = std::nullopt;       // lights the night; absent: no moon
  std::optional<SkyCondition> condition = std::nullopt;  // perez only; before irradiance
  double height_m = 0.0;                                 // of the place above the sea: thinner air, darker sky
};

// What of these options lies outside the chosen model's range for that sun, and what is done instead: a sentence each.
std::vector<std::string> beyond_range(const SkyOptions& options, const SunPosition& sun);

// Lux that given irradiances, or a given condition, put on a plane facing the sun; nothing where neither is given.
std::optional<double> given_sun_lux(const SkyOptions& options, const SunPosition& sun);

// A sky for that sun, from noon to night. Throws std::runtime_error that names an unknown model and lists the known
// ones, or says what is wrong with a picture. Every sky but `none` gets clouds, and with the sun down moon and airglow.
std::unique_ptr<SkyModel> make_sky(const SkyOptions& options, const SunPosition& sun);

}  // namespace render
