#include "render/shafts/reference/medium_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "render/shafts/reference/endless.h"

namespace render {
namespace {

constexpr double kRelative = 1e-10;  // of each lit segment
constexpr double kDeepest = 50.0;    // exp(-50) = 2e-22: nothing beyond is seen

// (1 - exp(-x)) / x.
double fall_off(double x) {
  return x == 0.0 ? 1.0 : -std::expm1(-x) / x;
}

// Light that runs along a box's faces never comes through them. A component of that size is what rounding leaves of a
// right angle; divided by, it would make ways of metres of a point's own rounding.
bool runs_along(double component) {
  return std::abs(component) < 1e-12;
}

double sun_way_m(const Box& box, const glm::dvec3& point, const glm::dvec3& sun) {
  double way = kEndless;
  for (int i = 0; i < 3; ++i) {
    if (runs_along(sun[i])) continue;
    way = std::min(way, ((sun[i] > 0.0 ? box.max_in_world : box.min_in_world)[i] - point[i]) / sun[i]);
  }
  return std::max(way, 0.0);
}

// Where on the ray the face changes through which sunlight enters: crossings of the three linear ways.
void add_face_changes(const Box& box, const ViewRay& ray, const glm::dvec3& sun, std::vector<double>& places) {
  const double from = places.front();
  const double to = places.back();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (runs_along(sun[i]) || runs_along(sun[j])) continue;
    const auto start = [&](int k) {
      return ((sun[k] > 0.0 ? box.max_in_world : box.min_in_world)[k] - ray.origin_in_world[k]) / sun[k];
    };
    const double slope = ray.direction_in_world[i] / sun[i] - ray.direction_in_world[j] / sun[j];
    if (slope == 0.0) continue;
    const double t = (start(i) - start(j)) / slope;
    if (t > from && t < to) places.push_back(t);
  }
  std::ranges::sort(places);
}

}  // namespace

double ReferenceMedium::extinction(const glm::dvec3& point_in_world) const {
  const double extinction = extinction_at(medium, point_in_world);
  return density ? extinction * density(point_in_world) : extinction;
}

std::optional<Segment> inside(const std::optional<Box>& extent, const ViewRay& ray, double end_m) {
  Segment segment{0.0, end_m};
  for (int i = 0; extent && i < 3; ++i) {
    const double low = extent->min_in_world[i] - ray.origin_in_world[i];
    const double high = extent->max_in_world[i] - ray.origin_in_world[i];
    const double along = ray.direction_in_world[i];
    if (runs_along(along)) {
      // Points that were computed to lie on a face lie beside it by rounding.
      const double rounding = 1e-12 * (std::abs(low) + std::abs(high) + std::abs(ray.origin_in_world[i]));
      if (low > rounding || high < -rounding) return std::nullopt;
      continue;
    }
    segment.from_m = std::max(segment.from_m, std::min(low / along, high / along));
    segment.to_m = std::min(segment.to_m, std::max(low / along, high / along));
  }
  if (segment.from_m >= segment.to_m) return std::nullopt;
  return segment;
}

double ReferenceMedium::depth(const glm::dvec3& from_in_world, const glm::dvec3& direction_in_world,
                              double length_m) const {
  const std::optional<Segment> way = inside(medium.extent, {from_in_world, direction_in_world}, length_m);
  if (!way) return 0.0;
  const glm::dvec3 start = from_in_world + way->from_m * direction_in_world;
  const double length = way->to_m - way->from_m;
  if (!density) return optical_depth(medium, start, direction_in_world, length);
  // An endless way is counted in its own depth's variable, t = s / (1 - s).
  if (std::isinf(length)) {
    return integrate(
               [&](double s) {
                 const double rest = 1.0 - s;
                 return extinction(start + (s / rest) * direction_in_world) / (rest * rest);
               },
               0.0, 1.0, kRelative)
        .value;
  }
  return integrate([&](double t) { return extinction(start + t * direction_in_world); }, 0.0, length, kRelative).value;
}

double MediumRay::view_depth(double t_m) const {
  if (t_m <= entry_m_) return 0.0;
  if (!reference_medium_.density) {
    return optical_depth(reference_medium_.medium, at(entry_m_), ray_.direction_in_world, t_m - entry_m_);
  }
  return reference_medium_.depth(at(entry_m_), ray_.direction_in_world, t_m - entry_m_);
}

Quadrature MediumRay::fraction(const LitSegment& segment) const {
  const double before = view_depth(segment.from_m);
  const double across = reference_medium_.density
                            ? view_depth(segment.to_m) - before
                            : optical_depth(reference_medium_.medium, at(segment.from_m), ray_.direction_in_world,
                                            segment.to_m - segment.from_m);
  return {-std::exp(-before) * std::expm1(-across), 0.0};
}

Quadrature MediumRay::sunlit_fraction(const LitSegment& segment, const glm::dvec3& sun_direction_in_world) const {
  const std::optional<Box>& extent = reference_medium_.medium.extent;
  if (!extent) return fraction(segment);
  std::vector<double> places{segment.from_m, segment.to_m};
  add_face_changes(*extent, ray_, sun_direction_in_world, places);
  Quadrature sum;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const Quadrature piece = sunlit_piece(places[i], places[i + 1], sun_direction_in_world);
    sum = {sum.value + piece.value, sum.error + piece.error};
  }
  return sum;
}

Quadrature MediumRay::sunlit_piece(double from_m, double to_m, const glm::dvec3& sun) const {
  const Medium& medium = reference_medium_.medium;
  if (!reference_medium_.density && !medium.falloff) {
    const double a = from_m - entry_m_ + sun_way_m(*medium.extent, at(from_m), sun);
    const double b = to_m - entry_m_ + sun_way_m(*medium.extent, at(to_m), sun);
    const double extinction = medium.extinction_per_m;
    const double value =
        extinction * (to_m - from_m) * std::exp(-extinction * std::min(a, b)) * fall_off(extinction * std::abs(b - a));
    return {value, 0.0};
  }
  return integrate(
      [&](double t) {
        const glm::dvec3 point = at(t);
        const double sun_depth = reference_medium_.depth(point, sun, sun_way_m(*medium.extent, point, sun));
        return reference_medium_.extinction(point) * std::exp(-view_depth(t) - sun_depth);
      },
      from_m, to_m, kRelative);
}

Quadrature MediumRay::point_fraction(const LitSegment& segment, const glm::dvec3& light_in_world) const {
  const glm::dvec3 to_light = light_in_world - ray_.origin_in_world;
  const double nearest = glm::dot(to_light, ray_.direction_in_world);
  // A light on the ray itself would be infinitely bright.
  const double distance = std::max(glm::length(to_light - nearest * ray_.direction_in_world), 1e-9);
  const auto angle = [&](double t) { return std::atan2(t - nearest, distance); };
  const auto value = [&](double at_rad) {
    const double t = nearest + distance * std::tan(at_rad);
    const glm::dvec3 point = at(t);
    const double way = distance / std::cos(at_rad);
    const glm::dvec3 direction = (light_in_world - point) / way;
    const double depth = view_depth(t) + reference_medium_.depth(point, direction, way);
    if (depth > kDeepest) return 0.0;
    const double cosine = glm::dot(direction, ray_.direction_in_world);
    return reference_medium_.extinction(point) * std::exp(-depth) *
           phase(reference_medium_.medium.phase_function, reference_medium_.medium.g, cosine) / distance;
  };
  const double to = std::isinf(segment.to_m) ? 0.5 * std::numbers::pi * (1.0 - 1e-15) : angle(segment.to_m);
  return integrate(value, angle(segment.from_m), to, kRelative);
}

}  // namespace render
