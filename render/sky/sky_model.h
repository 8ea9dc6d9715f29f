#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "render/sun/sun.h"

namespace render {

// The sky's light at one instant, without the sun's disc.
class SkyModel {
 public:
  virtual ~SkyModel() = default;

  // Luminance in cd/m2 as linear Rec. 709 seen in `direction_in_world` (unit vector, any length is normalised).
  // Below the horizon: what the model says of the ground, by default the horizon's own value. Never negative or NaN.
  virtual glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const = 0;
};

// What is asked of a sky; see the scene file's `sky`.
struct SkyOptions {
  std::string model = "perez";  // perez, preetham, cie:1..cie:15, scattering, image:FILE, none
  double turbidity = 3.0;
};

// A sky for that sun. Throws std::runtime_error that names an unknown model and lists the known ones.
std::unique_ptr<SkyModel> make_sky(const SkyOptions& options, const SunPosition& sun);

}  // namespace render
