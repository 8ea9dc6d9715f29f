#pragma once

#include <vector>

#include "app/synth/spec.h"
#include "ar/track/pose.h"

namespace app::synth {

// Natural cubic spline through values at increasing times: continuous to the second derivative. Outside the range it
// holds the end values' straight continuation.
class Spline3 {
 public:
  Spline3() = default;
  Spline3(std::vector<double> times_s, std::vector<glm::dvec3> values);
  glm::dvec3 operator()(double time_s) const;

 private:
  std::vector<double> times_s_;
  std::vector<glm::dvec3> values_;
  std::vector<glm::dvec3> second_;  // second derivatives at the knots
};

// The exactly known way of the camera.
class CameraPath {
 public:
  // `duration_s`: from the first frame to the last, over which an orbit runs.
  CameraPath(const PathSpec& spec, double duration_s, std::uint32_t seed);
  ar::Rigid3 world_from_camera(double time_s) const;

 private:
  PathSpec spec_;
  double duration_s_;
  Spline3 position_;
  Spline3 target_;
  std::array<double, 18> sway_phase_{};
};

// A camera at `position` that looks at `target` with the horizon level; looking straight down, north is up.
ar::Rigid3 look_at(const glm::dvec3& position, const glm::dvec3& target);

}  // namespace app::synth
