#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "app/synth/path.h"
#include "app/synth/spec.h"

namespace app::synth {

// What the camera can see at all from its path: detail is baked there and nowhere else. Errs to the safe side.
class Gaze {
 public:
  Gaze() = default;  // sees everything
  Gaze(const Spec& spec, const CameraPath& path);
  // Whether any of a sphere may be in view at some time.
  bool sees(const glm::vec3& centre, float radius_m) const;
  // Whether any of a cone of far directions may be in view; `direction` a unit vector.
  bool sees_far(const glm::vec3& direction, float half_angle_rad) const;

 private:
  struct View {
    glm::vec3 eye, axis;
  };
  std::vector<View> views_;  // empty: everything is seen
  float half_angle_rad_ = 0.0F;
};

}  // namespace app::synth
