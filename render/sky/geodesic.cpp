#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <queue>

#include "render/sky/spherical_triangle.h"
#include "render/sky/tessellation.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

// What a quarter of a triangle shows at its middle.
struct Sample {
  glm::dvec3 luminance_rgb;
  double visibility;
};

struct Node {
  SphericalTriangle triangle;
  std::array<Sample, 4> quarters;
  double smooth_lux;  // estimated error on level ground where the sky changes smoothly
  double edge_lux;    // the same where an edge of what is seen passes through
  bool operator<(const Node& other) const { return smooth_lux + edge_lux < other.smooth_lux + other.edge_lux; }
};

double seen(const Sample& sample) {
  return luminance(sample.luminance_rgb) * sample.visibility;
}

class Refiner {
 public:
  Refiner(const SkyModel& sky, const SkyVisibility& visibility) : sky_(sky), visibility_(visibility) {}

  Node node(const SphericalTriangle& triangle) const {
    Node result{triangle, {}, 0.0, 0.0};
    const auto quarters = triangle.quarters();
    double level = 0.0;
    double mean = 0.0;
    double lowest = 1e300;
    double highest = 0.0;
    bool edge = false;
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::dvec3 middle = quarters[i].centroid();
      result.quarters[i] = {sky_.luminance_rgb(middle), visibility_.seen ? visibility_.seen(middle) : 1.0};
      edge = edge || result.quarters[i].visibility != result.quarters[0].visibility;
      const double value = seen(result.quarters[i]);
      const double projected = quarters[i].moment_sr().z;
      level += projected;
      mean += value * projected;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    mean /= level;
    edge = edge || edge_within(triangle, quarters);
    // The middle quarter stands for what one sample would have seen. A share of the contrast guards against samples
    // that agree by chance. An edge leaves each quarter's sample right or wrong as a whole.
    if (edge) {
      result.edge_lux = 0.25 * level * std::max(highest, luminance(result.quarters[3].luminance_rgb));
    } else {
      result.smooth_lux = level * (std::abs(mean - seen(result.quarters[3])) / 3.0 + 0.02 * (highest - lowest));
    }
    return result;
  }

 private:
  bool edge_within(const SphericalTriangle& triangle, const std::array<SphericalTriangle, 4>& quarters) const {
    if (!visibility_.seen) return false;
    if (visibility_.edge_distance_rad) {
      const glm::dvec3 middle = triangle.centroid();
      double nearest = 1.0;
      for (const glm::dvec3& corner : triangle.corner) nearest = std::min(nearest, glm::dot(middle, corner));
      return visibility_.edge_distance_rad(middle) < std::acos(nearest);
    }
    const double one = visibility_.seen(triangle.corner[0]);
    for (const SphericalTriangle& quarter : quarters) {
      for (const glm::dvec3& corner : quarter.corner) {
        if (visibility_.seen(corner) != one) return true;
      }
    }
    return false;
  }

  const SkyModel& sky_;
  const SkyVisibility& visibility_;
};

// The upper half of an icosahedron that stands on a corner, its lower ring drawn up to the horizon, so that the
// fifteen triangles tile the half sphere exactly.
std::vector<SphericalTriangle> half_icosahedron() {
  constexpr double kFifth = 2.0 * std::numbers::pi / 5.0;
  const double ring = std::atan(0.5);
  const glm::dvec3 top(0.0, 0.0, 1.0);
  const auto upper = [&](int i) {
    return glm::dvec3(std::cos(ring) * std::cos(kFifth * i), std::cos(ring) * std::sin(kFifth * i), std::sin(ring));
  };
  const auto lower = [&](int i) { return glm::dvec3(std::cos(kFifth * (i + 0.5)), std::sin(kFifth * (i + 0.5)), 0.0); };
  std::vector<SphericalTriangle> triangles;
  for (int i = 0; i < 5; ++i) {
    triangles.push_back({{upper(i), upper(i + 1), top}});
    triangles.push_back({{upper(i), lower(i), upper(i + 1)}});
    triangles.push_back({{lower(i), lower(i + 1), upper(i + 1)}});
  }
  return triangles;
}

SkyPatch patch_of(const Node& node) {
  SkyPatch patch{node.triangle.centroid(), node.triangle.solid_angle_sr(), node.triangle.moment_sr(), glm::dvec3(0.0),
                 0.0};
  const auto quarters = node.triangle.quarters();
  for (std::size_t i = 0; i < 4; ++i) {
    const double share = quarters[i].solid_angle_sr() / patch.solid_angle_sr;
    patch.luminance_rgb += node.quarters[i].luminance_rgb * share;
    patch.visibility += node.quarters[i].visibility * share;
  }
  return patch;
}

}  // namespace

std::vector<SkyPatch> geodesic(const SkyModel& sky, const PatchOptions& options) {
  constexpr int kFirstLevels = 2;  // 240 triangles: fine enough to find the sun's surroundings
  const Refiner refiner(sky, options.visibility);
  std::vector<SphericalTriangle> start = half_icosahedron();
  for (int level = 0; level < kFirstLevels; ++level) {
    std::vector<SphericalTriangle> finer;
    for (const SphericalTriangle& triangle : start) {
      for (const SphericalTriangle& quarter : triangle.quarters()) finer.push_back(quarter);
    }
    start = std::move(finer);
  }
  // Smooth errors may all have the same sign and add up; at edges they are as often too high as too low.
  std::priority_queue<Node> nodes;
  double smooth = 0.0;
  double edge_squared = 0.0;
  double total = 0.0;
  const auto count = [&](const Node& node, double sign) {
    smooth += sign * node.smooth_lux;
    edge_squared += sign * node.edge_lux * node.edge_lux;
    const SkyPatch patch = patch_of(node);
    total += sign * luminance(patch.luminance_rgb) * patch.visibility * patch.moment_sr.z;
  };
  for (const SphericalTriangle& triangle : start) {
    const Node node = refiner.node(triangle);
    count(node, 1.0);
    nodes.push(node);
  }
  while (static_cast<int>(nodes.size()) + 3 <= options.max_patches &&
         smooth + std::sqrt(std::max(edge_squared, 0.0)) > options.max_error * total) {
    const Node worst = nodes.top();
    nodes.pop();
    count(worst, -1.0);
    for (const SphericalTriangle& quarter : worst.triangle.quarters()) {
      const Node finer = refiner.node(quarter);
      count(finer, 1.0);
      nodes.push(finer);
    }
  }
  std::vector<SkyPatch> patches;
  for (; !nodes.empty(); nodes.pop()) patches.push_back(patch_of(nodes.top()));
  return patches;
}

}  // namespace render
