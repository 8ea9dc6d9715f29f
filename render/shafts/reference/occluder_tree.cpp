#include "render/shafts/reference/occluder_tree.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

namespace render {
namespace {

constexpr unsigned kBranches = 8;
constexpr unsigned kLeafSize = 8;
// What single precision may lose between a box's middle and a half-space's value, as a part of all coordinates.
constexpr double kSlack = 2e-6;

// What Embree's builder makes on its own threads, before it is laid out for the walk.
struct Built {
  bool leaf = false;
  unsigned count = 0;
  std::array<void*, kBranches> child{};
  std::array<RTCBounds, kBranches> bounds{};
  std::array<unsigned, kLeafSize> triangle{};
};

Built* make_built(RTCThreadLocalAllocator allocator) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(Built), alignof(Built))) Built;
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned count, void* /*user*/) {
  Built* node = make_built(allocator);
  node->count = count;
  return node;
}
void set_children(void* node, void** children, unsigned count, void* /*user*/) {
  for (unsigned i = 0; i < count; ++i) static_cast<Built*>(node)->child[i] = children[i];
}
void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void* /*user*/) {
  for (unsigned i = 0; i < count; ++i) static_cast<Built*>(node)->bounds[i] = *bounds[i];
}
void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void* /*user*/) {
  Built* leaf = make_built(allocator);
  leaf->leaf = true;
  leaf->count = static_cast<unsigned>(count);
  for (unsigned i = 0; i < leaf->count; ++i) leaf->triangle[i] = primitives[i].primID;
  return leaf;
}

float lower(double x) {
  return std::nextafterf(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float upper(double x) {
  return std::nextafterf(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

RTCBuildPrimitive primitive(const OccluderTriangle& triangle, unsigned index) {
  const auto& [a, b, c] = triangle.corner;
  const glm::dvec3 low = glm::min(a, glm::min(b, c));
  const glm::dvec3 high = glm::max(a, glm::max(b, c));
  return {.lower_x = lower(low.x),
          .lower_y = lower(low.y),
          .lower_z = lower(low.z),
          .geomID = 0,
          .upper_x = upper(high.x),
          .upper_y = upper(high.y),
          .upper_z = upper(high.z),
          .primID = index};
}

glm::dvec3 middle_of(const std::vector<Instance>& instances) {
  glm::dvec3 sum(0.0);
  for (const Instance& instance : instances) sum += glm::dvec3(instance.world_from_model[3]);
  return instances.empty() ? sum : sum / static_cast<double>(instances.size());
}

// Whether nothing more need be known of a material's triangles than where they are.
bool is_opaque(const Model& model, const Material& material) {
  if (material.alpha_mode == AlphaMode::Opaque) return true;
  if (material.alpha_mode == AlphaMode::Blend) return false;
  int least = 255;
  if (material.base_color_texture.image >= 0) {
    const std::vector<std::uint8_t>& rgba =
        model.images[static_cast<std::size_t>(material.base_color_texture.image)].rgba;
    for (std::size_t i = 3; i < rgba.size(); i += 4) least = std::min(least, static_cast<int>(rgba[i]));
  }
  return material.base_color.a * static_cast<float>(least) / 255.0F >= material.alpha_cutoff;
}

void add_triangles(const Instance& instance, const glm::dvec3& origin, std::vector<OccluderTriangle>& out) {
  for (const Mesh& mesh : instance.model->meshes) {
    const Material& material = instance.model->materials[static_cast<std::size_t>(mesh.material)];
    const bool opaque = is_opaque(*instance.model, material);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      OccluderTriangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vertex& vertex = mesh.vertices[mesh.indices[i + k]];
        triangle.corner[k] =
            glm::dvec3(instance.world_from_model * glm::dvec4(glm::dvec3(vertex.position), 1.0)) - origin;
        triangle.uv[k] = vertex.uv;
      }
      if (!opaque) {
        triangle.model = instance.model.get();
        triangle.material = &material;
      }
      out.push_back(triangle);
    }
  }
}

}  // namespace

struct OccluderTree::Builder {
  OccluderTree& tree;
  std::vector<OccluderTriangle> ordered{};

  std::int32_t add(const Built& built) {
    if (built.leaf) {
      tree.leaves_.push_back({static_cast<std::uint32_t>(ordered.size()), built.count});
      for (unsigned i = 0; i < built.count; ++i) ordered.push_back(tree.triangles_[built.triangle[i]]);
      return ~static_cast<std::int32_t>(tree.leaves_.size() - 1);
    }
    const auto index = tree.nodes_.size();
    tree.nodes_.push_back({});
    Node node{};
    node.count = static_cast<int>(built.count);
    for (unsigned i = 0; i < built.count; ++i) {
      const RTCBounds& b = built.bounds[i];
      const std::array<std::array<double, 2>, 3> sides{
          {{b.lower_x, b.upper_x}, {b.lower_y, b.upper_y}, {b.lower_z, b.upper_z}}};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.middle[axis][i] = static_cast<float>(0.5 * (sides[axis][0] + sides[axis][1]));
        node.half[axis][i] = upper(0.5 * (sides[axis][1] - sides[axis][0]) * (1.0 + 1e-6) + kSlack * tree.radius_m_);
      }
      node.child[i] = add(*static_cast<const Built*>(built.child[i]));
    }
    tree.nodes_[index] = node;
    return static_cast<std::int32_t>(index);
  }
};

OccluderTree::OccluderTree(const std::vector<Instance>& instances) : origin_in_world_(middle_of(instances)) {
  for (const Instance& instance : instances) add_triangles(instance, origin_in_world_, triangles_);
  if (triangles_.empty()) return;
  std::vector<RTCBuildPrimitive> primitives;
  for (const OccluderTriangle& triangle : triangles_) {
    primitives.push_back(primitive(triangle, static_cast<unsigned>(primitives.size())));
    for (const glm::dvec3& corner : triangle.corner) {
      radius_m_ = std::max({radius_m_, std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)});
    }
  }
  const std::unique_ptr<RTCDeviceTy, void (*)(RTCDevice)> device(rtcNewDevice(nullptr), rtcReleaseDevice);
  if (!device) throw std::runtime_error("Embree: no device");
  const std::unique_ptr<RTCBVHTy, void (*)(RTCBVH)> bvh(rtcNewBVH(device.get()), rtcReleaseBVH);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.maxBranchingFactor = kBranches;
  arguments.maxLeafSize = kLeafSize;
  arguments.bvh = bvh.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  const void* const root = rtcBuildBVH(&arguments);
  if (root == nullptr) throw std::runtime_error("Embree: the tree of occluders could not be built");
  Builder builder{*this};
  const std::int32_t first = builder.add(*static_cast<const Built*>(root));
  triangles_ = std::move(builder.ordered);
  if (first >= 0) return;
  // So few triangles that the root is a leaf: a node above it that is always looked into.
  Node only{};
  only.count = 1;
  only.child[0] = first;
  for (auto& half : only.half) half[0] = upper(radius_m_ * (1.0 + 1e-6));
  nodes_.push_back(only);
}

OccluderTree::Limits::Limits(const SheetBounds& sheet, double radius_m) {
  const std::array<const HalfSpace*, 4> spaces{&sheet.plane, &sheet.lowest, &sheet.left, &sheet.right};
  for (std::size_t k = 0; k < 4; ++k) {
    normal[k] = glm::vec3(spaces[k]->normal);
    size[k] = glm::abs(normal[k]);
    offset[k] = static_cast<float>(spaces[k]->offset);
    slack[k] = static_cast<float>(kSlack * (std::abs(spaces[k]->offset) + radius_m));
  }
}

// Bit i: child i touches the sheet. Compares in single precision, on the side of looking into too many.
unsigned OccluderTree::reached(const Node& node, const Limits& limits) {
  std::array<std::array<float, kWidth>, 4> value;
  std::array<std::array<float, kWidth>, 4> reach;
  for (std::size_t k = 0; k < 4; ++k) {
    const glm::vec3 n = limits.normal[k];
    const glm::vec3 a = limits.size[k];
    for (std::size_t i = 0; i < kWidth; ++i) {
      value[k][i] = n.x * node.middle[0][i] + n.y * node.middle[1][i] + n.z * node.middle[2][i] + limits.offset[k];
      reach[k][i] = a.x * node.half[0][i] + a.y * node.half[1][i] + a.z * node.half[2][i] + limits.slack[k];
    }
  }
  unsigned mask = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(node.count); ++i) {
    const bool touches = (std::abs(value[0][i]) <= reach[0][i]) & (value[1][i] >= -reach[1][i]) &
                         (value[2][i] >= -reach[2][i]) & (value[3][i] <= reach[3][i]);
    mask |= (touches ? 1U : 0U) << i;
  }
  return mask;
}

}  // namespace render
