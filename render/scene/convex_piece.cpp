#include "render/scene/convex_piece.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "render/scene/model.h"

namespace render {
namespace {

constexpr std::size_t kMostTriangles = 64;
constexpr double kSmallest = 0.25;  // of the model's diagonal
constexpr double kFlat = 1e-5;      // of the piece's diagonal: single precision's rounding, and a little

using Triangle = std::array<glm::vec3, 3>;

double longest_edge(const Triangle& t) {
  return std::max({glm::distance(t[0], t[1]), glm::distance(t[1], t[2]), glm::distance(t[2], t[0])});
}

Triangle triangle_of(const Mesh& mesh, std::size_t first) {
  return {mesh.vertices[mesh.indices[first]].position, mesh.vertices[mesh.indices[first + 1]].position,
          mesh.vertices[mesh.indices[first + 2]].position};
}

// Sets of joined vertices.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  std::size_t set_of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[set_of(a)] = set_of(b); }

 private:
  std::vector<std::size_t> parent_;
};

using PointKey = std::array<float, 3>;

PointKey key_of(const glm::vec3& p) {
  return {p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};  // -0 is 0
}

Joined join_vertices(const Mesh& mesh) {
  Joined joined(mesh.vertices.size());
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto place = [&](std::uint32_t i) { return key_of(mesh.vertices[i].position); };
  std::ranges::sort(order, {}, place);
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (place(order[i]) == place(order[i - 1])) joined.join(order[i], order[i - 1]);
  }
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    joined.join(mesh.indices[i], mesh.indices[i + 1]);
    joined.join(mesh.indices[i], mesh.indices[i + 2]);
  }
  return joined;
}

glm::dvec3 size_of(const ConvexPiece& piece) {
  glm::dvec3 low(piece.triangles.front()[0]);
  glm::dvec3 high = low;
  for (const Triangle& triangle : piece.triangles) {
    for (const glm::vec3& corner : triangle) {
      low = glm::min(low, glm::dvec3(corner));
      high = glm::max(high, glm::dvec3(corner));
    }
  }
  return high - low;
}

// The second longest edge of its box: a beam is not large, however long it is.
double width_of(const ConvexPiece& piece) {
  const glm::dvec3 size = size_of(piece);
  return std::max(std::min(size.x, size.y), std::min(std::max(size.x, size.y), size.z));
}

glm::dvec3 face_vector(const Triangle& t) {  // twice the area times the normal
  return glm::cross(glm::dvec3(t[1]) - glm::dvec3(t[0]), glm::dvec3(t[2]) - glm::dvec3(t[0]));
}

// Whether no corner lies above any face.
bool bulges_outwards(const ConvexPiece& piece, double tolerance_m) {
  return std::ranges::all_of(piece.triangles, [&](const Triangle& face) {
    const glm::dvec3 across = face_vector(face);
    const double size = glm::length(across);
    return std::ranges::all_of(piece.triangles, [&](const Triangle& other) {
      return std::ranges::all_of(other, [&](const glm::vec3& corner) {
        return glm::dot(across, glm::dvec3(corner) - glm::dvec3(face[0])) <= tolerance_m * size;
      });
    });
  });
}

// Every edge is there once in each direction.
bool closed(const ConvexPiece& piece) {
  std::set<std::pair<PointKey, PointKey>> edges;
  for (const Triangle& t : piece.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!edges.emplace(key_of(t[i]), key_of(t[(i + 1) % 3])).second) return false;
    }
  }
  return std::ranges::all_of(edges, [&](const auto& edge) { return edges.contains({edge.second, edge.first}); });
}

// Area of the convex hull of corners in a plane (Andrew 1979, monotone chains).
double hull_area(std::vector<std::pair<double, double>> points) {
  std::ranges::sort(points);
  const auto cross = [](const auto& o, const auto& a, const auto& b) {
    return (a.first - o.first) * (b.second - o.second) - (a.second - o.second) * (b.first - o.first);
  };
  double twice = 0.0;
  for (int side = 0; side < 2; ++side) {
    std::vector<std::pair<double, double>> chain;
    for (const auto& point : points) {
      while (chain.size() >= 2 && cross(chain[chain.size() - 2], chain.back(), point) <= 0.0) chain.pop_back();
      chain.push_back(point);
    }
    for (std::size_t i = 1; i < chain.size(); ++i) {
      twice += chain[i - 1].first * chain[i].second - chain[i - 1].second * chain[i].first;
    }
    std::ranges::reverse(points);
  }
  return 0.5 * twice;
}

// All in one plane, and as large as their outline's hull.
bool flat_and_convex(const ConvexPiece& piece, double tolerance_m) {
  glm::dvec3 across(0.0);
  double area = 0.0;
  for (const Triangle& triangle : piece.triangles) {
    across += face_vector(triangle);
    area += 0.5 * glm::length(face_vector(triangle));
  }
  if (!(area > 0.0) || glm::length(across) < 1.999 * area) return false;
  const glm::dvec3 normal = glm::normalize(across);
  const glm::dvec3 origin(piece.triangles.front()[0]);
  const glm::dvec3 aside = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(normal, aside));
  const glm::dvec3 v = glm::cross(normal, u);
  std::vector<std::pair<double, double>> points;
  for (const Triangle& triangle : piece.triangles) {
    for (const glm::vec3& corner : triangle) {
      const glm::dvec3 from = glm::dvec3(corner) - origin;
      if (std::abs(glm::dot(normal, from)) > tolerance_m) return false;
      points.emplace_back(glm::dot(u, from), glm::dot(v, from));
    }
  }
  return area >= (1.0 - 1e-5) * hull_area(std::move(points));
}

bool is_convex(ConvexPiece& piece) {
  const double tolerance_m = kFlat * glm::length(size_of(piece));
  piece.flat = flat_and_convex(piece, tolerance_m);
  return piece.flat || (bulges_outwards(piece, tolerance_m) && closed(piece));
}

void add_pieces(const Mesh& mesh, std::size_t index, double model_m, std::vector<ConvexPiece>& out) {
  // What has so few triangles and is so large has a large triangle: most meshes are done here.
  constexpr double kLargeTriangle = kSmallest / 8.0;
  std::vector<std::size_t> large;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    if (longest_edge(triangle_of(mesh, i)) >= kLargeTriangle * model_m) large.push_back(i);
  }
  if (large.empty()) return;
  Joined joined = join_vertices(mesh);
  std::map<std::size_t, ConvexPiece> pieces;
  for (const std::size_t i : large) pieces[joined.set_of(mesh.indices[i])].mesh = index;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto found = pieces.find(joined.set_of(mesh.indices[i]));
    if (found == pieces.end() || found->second.triangles.size() > kMostTriangles) continue;
    found->second.triangles.push_back(triangle_of(mesh, i));
    const auto first = mesh.indices.begin() + static_cast<std::ptrdiff_t>(i);
    found->second.vertices.insert(found->second.vertices.end(), first, first + 3);
  }
  for (auto& [set, piece] : pieces) {
    if (piece.triangles.size() > kMostTriangles || width_of(piece) < kSmallest * model_m || !is_convex(piece)) {
      continue;
    }
    std::ranges::sort(piece.vertices);
    const auto repeated = std::ranges::unique(piece.vertices);
    piece.vertices.erase(repeated.begin(), repeated.end());
    out.push_back(std::move(piece));
  }
}

// Moller & Trumbore 1997; inside the triangle or on its edge, and ahead of the origin.
bool meets(const Triangle& t, const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 a(t[0]);
  const glm::dvec3 ab = glm::dvec3(t[1]) - a;
  const glm::dvec3 ac = glm::dvec3(t[2]) - a;
  const glm::dvec3 p = glm::cross(direction, ac);
  const double determinant = glm::dot(ab, p);
  if (determinant == 0.0) return false;
  const glm::dvec3 from = origin - a;
  const double u = glm::dot(from, p) / determinant;
  const glm::dvec3 q = glm::cross(from, ab);
  const double v = glm::dot(direction, q) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && glm::dot(ac, q) / determinant > 0.0;
}

}  // namespace

std::vector<ConvexPiece> find_convex_pieces(const Model& model) {
  std::vector<ConvexPiece> pieces;
  const double model_m = glm::distance(model.bounds_min, model.bounds_max);
  for (std::size_t i = 0; i < model.meshes.size(); ++i) {
    const Material& material = model.materials[static_cast<std::size_t>(model.meshes[i].material)];
    if (material.alpha_mode == AlphaMode::Opaque) add_pieces(model.meshes[i], i, model_m, pieces);
  }
  return pieces;
}

bool meets(const ConvexPiece& piece, const glm::dvec3& origin, const glm::dvec3& direction) {
  return std::ranges::any_of(piece.triangles, [&](const Triangle& triangle) {
    const bool faces = piece.flat || glm::dot(face_vector(triangle), direction) < 0.0;
    return faces && meets(triangle, origin, direction);
  });
}

}  // namespace render
