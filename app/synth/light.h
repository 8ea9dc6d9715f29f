#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>

#include "app/synth/spec.h"
#include "render/sky/sky_light.h"
#include "render/sky/sky_model.h"
#include "render/sun/sun.h"

namespace app::synth {

// The real light of the clip: one sun and one sky for its few seconds.
class Light {
 public:
  explicit Light(const Spec& spec);

  const render::SunPosition& sun() const { return sun_; }
  const glm::vec3& sun_direction() const { return sun_direction_; }      // unit, towards the sun's apparent place
  const glm::vec3& sun_illuminance() const { return sun_illuminance_; }  // lux on a plane facing it
  float sun_radius_rad() const { return sun_radius_rad_; }
  // Lux from the sky and the ground around, on a plane with that unit normal.
  glm::vec3 sky_illuminance(const glm::vec3& normal) const;
  glm::vec3 sky_luminance(const glm::vec3& direction) const;  // cd/m2
  // Display-linear per cd/m2: as the spec says, or so that a grey card lying in the sun comes out as 18 % grey.
  double exposure() const { return exposure_; }

 private:
  render::SunPosition sun_;
  glm::vec3 sun_direction_{0.0F};
  glm::vec3 sun_illuminance_{0.0F};
  float sun_radius_rad_ = 0.0F;
  std::shared_ptr<const render::SkyModel> sky_;
  std::array<glm::vec3, 9> irradiance_{};  // coefficients of 1, y, z, x, xy, yz, 3z2-1, xz, x2-y2
  double exposure_ = 0.0;
};

}  // namespace app::synth
