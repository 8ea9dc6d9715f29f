#include "app/synth/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/synth/noise.h"

namespace app::synth {

namespace {

// Second derivatives of the natural spline: the tridiagonal system of Press et al., Numerical Recipes, section 3.3.
std::vector<glm::dvec3> natural_second_derivatives(const std::vector<double>& t, const std::vector<glm::dvec3>& v) {
  const std::size_t n = t.size();
  std::vector<glm::dvec3> second(n, glm::dvec3(0.0));
  std::vector<glm::dvec3> rhs(n, glm::dvec3(0.0));
  std::vector<double> upper(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = t[i] - t[i - 1];
    const double after = t[i + 1] - t[i];
    const double pivot = 2.0 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    const glm::dvec3 bend = 6.0 * ((v[i + 1] - v[i]) / after - (v[i] - v[i - 1]) / before);
    rhs[i] = (bend - before * rhs[i - 1]) / pivot;
  }
  for (std::size_t i = n; i-- > 1;) {
    if (i + 1 < n) second[i] = rhs[i] - upper[i] * second[i + 1];
  }
  return second;
}

// Three incommensurate slow waves a channel: smooth everywhere, never repeating within a clip.
double hand(double time_s, const double* phase) {
  constexpr std::array kHertz{0.31, 0.83, 1.71};
  constexpr std::array kWeight{0.70, 0.24, 0.06};
  double sum = 0.0;
  for (std::size_t i = 0; i < kHertz.size(); ++i)
    sum += kWeight[i] * std::sin(2.0 * std::numbers::pi * kHertz[i] * time_s + phase[i]);
  return sum;
}

}  // namespace

Spline3::Spline3(std::vector<double> times_s, std::vector<glm::dvec3> values)
    : times_s_(std::move(times_s)),
      values_(std::move(values)),
      second_(natural_second_derivatives(times_s_, values_)) {}

glm::dvec3 Spline3::operator()(double time_s) const {
  if (values_.size() == 1) return values_.front();
  const auto upper = std::upper_bound(times_s_.begin() + 1, times_s_.end() - 1, time_s);
  const auto i = static_cast<std::size_t>(upper - times_s_.begin()) - 1;
  const double h = times_s_[i + 1] - times_s_[i];
  const double b = (time_s - times_s_[i]) / h;
  const double a = 1.0 - b;
  const glm::dvec3 line = a * values_[i] + b * values_[i + 1];
  if (b < 0.0 || b > 1.0) {  // straight on, with the slope of the end
    const double end = b < 0.0 ? 0.0 : 1.0;
    const double c = (1.0 - 3.0 * (1.0 - end) * (1.0 - end)) * h * h / 6.0;
    const double d = (3.0 * end * end - 1.0) * h * h / 6.0;
    return line + (b - end) * (c * second_[i] + d * second_[i + 1]);
  }
  return line + ((a * a * a - a) * second_[i] + (b * b * b - b) * second_[i + 1]) * (h * h / 6.0);
}

CameraPath::CameraPath(const PathSpec& spec, double duration_s, std::uint32_t seed)
    : spec_(spec), duration_s_(std::max(duration_s, 1e-9)) {
  std::vector<double> times;
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> targets;
  for (const PathKey& key : spec.keys) {
    times.push_back(key.time_s);
    positions.push_back(key.position);
    targets.push_back(key.target);
  }
  if (!spec.orbit) {
    position_ = Spline3(times, positions);
    target_ = Spline3(times, targets);
  }
  Random random(seed);
  for (double& phase : sway_phase_) phase = 2.0 * std::numbers::pi * random.next();
}

ar::Rigid3 CameraPath::world_from_camera(double time_s) const {
  glm::dvec3 position;
  glm::dvec3 target;
  if (spec_.orbit) {
    const Orbit& orbit = *spec_.orbit;
    const double heading = orbit.from_rad + (orbit.to_rad - orbit.from_rad) * time_s / duration_s_;
    position = {orbit.center.x + orbit.radius_m * std::sin(heading),
                orbit.center.y + orbit.radius_m * std::cos(heading), orbit.height_m};
    target = orbit.center;
  } else {
    position = position_(time_s);
    target = target_(time_s);
  }
  std::array<double, 6> sway{};
  for (std::size_t i = 0; i < sway.size(); ++i) sway[i] = hand(time_s, &sway_phase_[3 * i]);
  ar::Rigid3 pose = look_at(position + spec_.sway_m * glm::dvec3(sway[0], sway[1], sway[2]), target);
  const cv::Vec4d turn{1.0, 0.5 * spec_.sway_rad * sway[3], 0.5 * spec_.sway_rad * sway[4],
                       0.5 * spec_.sway_rad * sway[5]};
  pose.rotation = pose.rotation * ar::rotation_from_quaternion_wxyz(turn / cv::norm(turn));
  return pose;
}

ar::Rigid3 look_at(const glm::dvec3& position, const glm::dvec3& target) {
  const glm::dvec3 forward = glm::normalize(target - position);
  const glm::dvec3 side = glm::cross(forward, glm::dvec3(0.0, 0.0, 1.0));
  const glm::dvec3 right = glm::length(side) > 1e-9 ? glm::normalize(side) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 down = glm::cross(forward, right);
  ar::Rigid3 pose;
  pose.rotation = {right.x, down.x, forward.x, right.y, down.y, forward.y, right.z, down.z, forward.z};
  pose.translation = {position.x, position.y, position.z};
  return pose;
}

}  // namespace app::synth
