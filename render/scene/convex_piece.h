#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace render {

struct Model;

// A large opaque part of a model whose surface is that of a convex body, or a flat convex sheet: a slab, a floor. Of
// such a one it is easy to tell whether anything can be seen of what it shades (render/shadow/shadow_fit.h).
struct ConvexPiece {
  std::size_t mesh = 0;
  std::vector<std::uint32_t> vertices;              // of that mesh, ascending: all that the piece's triangles use
  std::vector<std::array<glm::vec3, 3>> triangles;  // counter-clockwise seen from outside
  bool flat = false;
};

// The pieces of at most 64 triangles that are at least a quarter as wide as the model's diagonal. Corners of the same
// place count as joined, whatever their normals.
std::vector<ConvexPiece> find_convex_pieces(const Model& model);

// Whether a ray from outside the piece meets it, its edges too; `direction` need not be unit.
bool meets(const ConvexPiece& piece, const glm::dvec3& origin, const glm::dvec3& direction);

}  // namespace render
