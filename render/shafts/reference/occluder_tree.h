#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "render/scene/model.h"

namespace render {

// A triangle that casts shadows, in metres from the tree's origin.
struct OccluderTriangle {
  std::array<glm::dvec3, 3> corner;
  std::array<glm::vec2, 3> uv;
  const Model* model = nullptr;        // what its material and images belong to
  const Material* material = nullptr;  // null: opaque, so that nothing more need be known
};

// A set of points: |plane| <= 0, lowest >= 0, left >= 0, right <= 0, each normal . x + offset. What a node's box must
// touch to be looked into.
struct HalfSpace {
  glm::dvec3 normal{0.0};
  double offset = 0.0;
};
struct SheetBounds {
  HalfSpace plane;
  HalfSpace lowest;
  HalfSpace left;
  HalfSpace right;
};

// All triangles of a scene in a tree of boxes that Embree builds (surface-area heuristic). Embree traces single rays in
// single precision; what the reference asks for is every triangle that a whole sheet of rays can meet, in double
// precision, so the walk is our own.
class OccluderTree {
 public:
  explicit OccluderTree(const std::vector<Instance>& instances);

  const glm::dvec3& origin_in_world() const { return origin_in_world_; }
  std::size_t size() const { return triangles_.size(); }

  // Calls found(triangle) for every triangle that may reach into the sheet, and some more. Points are counted from
  // the tree's origin.
  template <typename Found>
  void walk(const SheetBounds& sheet, Found&& found) const;

 private:
  static constexpr int kWidth = 8;
  // Boxes of up to eight children, side by side for the processor's vectors. Single precision: made a little larger.
  struct Node {
    std::array<std::array<float, kWidth>, 3> middle;
    std::array<std::array<float, kWidth>, 3> half;
    std::array<std::int32_t, kWidth> child;  // node, or ~leaf
    int count = 0;
  };
  struct Leaf {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };
  struct Builder;

  // A sheet in single precision, and by how much that may be off.
  struct Limits {
    Limits(const SheetBounds& sheet, double radius_m);
    std::array<glm::vec3, 4> normal;
    std::array<glm::vec3, 4> size;  // of the normals' coordinates
    std::array<float, 4> offset;
    std::array<float, 4> slack;
  };
  static unsigned reached(const Node& node, const Limits& limits);

  glm::dvec3 origin_in_world_{0.0};
  double radius_m_ = 0.0;  // of a box about the origin that holds everything
  std::vector<OccluderTriangle> triangles_;
  std::vector<Node> nodes_;  // the first is the root; none where there are no triangles
  std::vector<Leaf> leaves_;
};

template <typename Found>
void OccluderTree::walk(const SheetBounds& sheet, Found&& found) const {
  if (nodes_.empty()) return;
  const Limits limits(sheet, radius_m_);
  std::array<std::int32_t, 512> stack;  // eight at each of Embree's at most 32 levels, and to spare
  int waiting = 0;
  stack[0] = 0;
  waiting = 1;
  while (waiting > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[static_cast<std::size_t>(--waiting)])];
    for (unsigned left = reached(node, limits); left != 0; left &= left - 1) {
      const std::int32_t child = node.child[static_cast<std::size_t>(__builtin_ctz(left))];
      if (child >= 0) {
        stack[static_cast<std::size_t>(waiting++)] = child;
        continue;
      }
      const Leaf& leaf = leaves_[static_cast<std::size_t>(~child)];
      for (const OccluderTriangle& triangle : std::span(triangles_).subspan(leaf.first, leaf.count)) found(triangle);
    }
  }
}

}  // namespace render
