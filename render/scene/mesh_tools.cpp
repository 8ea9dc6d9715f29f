#include "render/scene/mesh_tools.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace render {
namespace {

bool normalize(glm::vec3& v) {
  const double length2 = glm::dot(glm::dvec3(v), glm::dvec3(v));
  if (!(length2 > 1e-30) || !std::isfinite(length2)) return false;
  v = glm::vec3(glm::dvec3(v) / std::sqrt(length2));
  return true;
}

// Any unit vector orthogonal to the unit vector n [Frisvad 2012, by the smallest component].
glm::vec3 any_orthogonal(const glm::vec3& n) {
  const glm::vec3 a = glm::abs(n);
  const glm::vec3 axis =
      a.x <= a.y && a.x <= a.z ? glm::vec3(1, 0, 0) : (a.y <= a.z ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1));
  glm::vec3 t = axis - n * glm::dot(n, axis);
  normalize(t);
  return t;
}

// Twice the area times the face's normal.
glm::vec3 face_vector(const Mesh& mesh, std::size_t first) {
  const glm::dvec3 a(mesh.vertices[mesh.indices[first]].position);
  const glm::dvec3 b(mesh.vertices[mesh.indices[first + 1]].position);
  const glm::dvec3 c(mesh.vertices[mesh.indices[first + 2]].position);
  return glm::vec3(glm::cross(b - a, c - a));
}

struct Gradient {
  glm::vec3 u{0.0F};        // direction in which u grows, weighted by the triangle's area in the texture
  float handedness = 0.0F;  // +1, -1; 0 where the texture coordinates are degenerate
};

Gradient texture_gradient(const Mesh& mesh, std::size_t first) {
  const Vertex& a = mesh.vertices[mesh.indices[first]];
  const Vertex& b = mesh.vertices[mesh.indices[first + 1]];
  const Vertex& c = mesh.vertices[mesh.indices[first + 2]];
  const glm::vec2 ab = b.uv - a.uv;
  const glm::vec2 ac = c.uv - a.uv;
  const float determinant = ab.x * ac.y - ac.x * ab.y;
  if (!(std::abs(determinant) > 1e-20F) || !std::isfinite(determinant)) return {};
  const float sign = determinant > 0.0F ? 1.0F : -1.0F;
  glm::vec3 u = sign * (ac.y * (b.position - a.position) - ab.y * (c.position - a.position));
  if (!normalize(u)) return {};
  // glTF's bitangent is cross(normal, tangent) * w and points to where v = 0 is the top, so that v grows along -b.
  return {u * glm::length(glm::cross(b.position - a.position, c.position - a.position)), sign};
}

}  // namespace

void update_bounds(Model& model) {
  glm::vec3 low(std::numeric_limits<float>::infinity());
  glm::vec3 high(-std::numeric_limits<float>::infinity());
  for (const Mesh& mesh : model.meshes) {
    for (const Vertex& vertex : mesh.vertices) {
      low = glm::min(low, vertex.position);
      high = glm::max(high, vertex.position);
    }
  }
  const bool any = low.x <= high.x;
  model.bounds_min = any ? low : glm::vec3(0.0F);
  model.bounds_max = any ? high : glm::vec3(0.0F);
}

void make_flat_normals(Mesh& mesh) {
  std::vector<Vertex> vertices;
  vertices.reserve(mesh.indices.size());
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    vertices.push_back(mesh.vertices[mesh.indices[i]]);
    glm::vec3 normal = face_vector(mesh, i - i % 3);
    if (!normalize(normal)) normal = glm::vec3(0, 0, 1);
    vertices.back().normal = normal;
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
  mesh.vertices = std::move(vertices);
}

void repair_normals(Mesh& mesh) {
  std::vector<char> broken(mesh.vertices.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (normalize(mesh.vertices[i].normal)) continue;
    broken[i] = 1;
    any = true;
    mesh.vertices[i].normal = glm::vec3(0.0F);
  }
  for (std::size_t i = 0; any && i < mesh.indices.size(); ++i) {
    if (broken[mesh.indices[i]]) mesh.vertices[mesh.indices[i]].normal += face_vector(mesh, i - i % 3);
  }
  for (std::size_t i = 0; any && i < mesh.vertices.size(); ++i) {
    if (broken[i] && !normalize(mesh.vertices[i].normal)) mesh.vertices[i].normal = glm::vec3(0, 0, 1);
  }
}

void make_tangents(Mesh& mesh) {
  struct Sum {
    glm::vec3 u{0.0F};
    bool used = false;
    std::uint32_t vertex = 0;
  };
  // Per vertex one sum for each handedness; [1] also takes what has none.
  std::vector<std::array<Sum, 2>> sums(mesh.vertices.size());
  std::vector<std::uint8_t> side(mesh.indices.size() / 3);
  for (std::size_t face = 0; face < side.size(); ++face) {
    const Gradient gradient = texture_gradient(mesh, face * 3);
    side[face] = gradient.handedness > 0.0F ? 0 : 1;
    for (std::size_t k = 0; k < 3; ++k) {
      Sum& sum = sums[mesh.indices[face * 3 + k]][side[face]];
      sum.u += gradient.u;
      sum.used = true;
    }
  }
  const std::size_t original_count = mesh.vertices.size();
  for (std::size_t i = 0; i < original_count; ++i) {
    sums[i][0].vertex = sums[i][1].vertex = static_cast<std::uint32_t>(i);
    if (sums[i][0].used && sums[i][1].used) {
      sums[i][1].vertex = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(Vertex(mesh.vertices[i]));
    }
    for (std::size_t s = 0; s < 2; ++s) {
      if (!sums[i][s].used) continue;
      mesh.vertices[sums[i][s].vertex].tangent = glm::vec4(sums[i][s].u, s == 0 ? -1.0F : 1.0F);
    }
  }
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = sums[mesh.indices[i]][side[i / 3]].vertex;
  repair_tangents(mesh);
}

void repair_tangents(Mesh& mesh) {
  for (Vertex& vertex : mesh.vertices) {
    glm::vec3 t(vertex.tangent);
    t -= vertex.normal * glm::dot(vertex.normal, t);
    if (!normalize(t)) t = any_orthogonal(vertex.normal);
    vertex.tangent = glm::vec4(t, vertex.tangent.w < 0.0F ? -1.0F : 1.0F);
  }
}

}  // namespace render
