#include "data/generator/outline.h"

#include <cmath>
#include <stdexcept>

namespace generator {
namespace {

float cross(const glm::vec2& a, const glm::vec2& b) {
  return a.x * b.y - a.y * b.x;
}

bool inside(const glm::vec2& p, const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  return cross(b - a, p - a) > 0.0F && cross(c - b, p - b) > 0.0F && cross(a - c, p - c) > 0.0F;
}

// Keeps real faces only: points in one place (hard edges) have no face between them.
void add_triangle(render::Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const glm::vec3& pa = mesh.vertices[a].position;
  const glm::vec3 face = glm::cross(mesh.vertices[b].position - pa, mesh.vertices[c].position - pa);
  if (glm::length(face) > 1e-9F) mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

void add_quad(render::Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
}

glm::vec2 map(const glm::mat3& m, const glm::vec2& p) {
  return glm::vec2(m * glm::vec3(p, 1.0F));
}

void add_sides(render::Mesh& mesh, const Outline& outline, float half, const Frame& frame, const Mapping& mapping) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::size_t n = outline.size();
  for (const OutlinePoint& p : outline) {
    const glm::vec3 normal = frame.axes * glm::vec3(p.normal, 0.0F);
    for (const float z : {-half, half}) {
      mesh.vertices.push_back({frame.point(glm::vec3(p.position, z)), normal, glm::vec4(0.0F),
                               map(mapping.uv_from_side, {p.across, z + half})});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = first + 2 * i;
    const std::uint32_t b = first + 2 * ((i + 1) % static_cast<std::uint32_t>(n));
    add_quad(mesh, a, b, b + 1, a + 1);
  }
}

// How far a bevel moves point i inwards, for a bevel of 1: at a hard edge both points go to the mitre.
glm::vec2 inward(const Outline& outline, std::size_t i) {
  const OutlinePoint& p = outline[i];
  for (const std::size_t k : {(i + 1) % outline.size(), (i + outline.size() - 1) % outline.size()}) {
    const OutlinePoint& twin = outline[k];
    if (glm::distance(twin.position, p.position) > 1e-6F) continue;
    return -(p.normal + twin.normal) / (1.0F + glm::dot(p.normal, twin.normal));
  }
  return -p.normal;
}

// One end face and its bevel; `side` is -1 or +1 along z.
void add_cap(render::Mesh& mesh, const Outline& outline, float half, float bevel, float side, const Frame& frame,
             const Mapping& mapping) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto n = static_cast<std::uint32_t>(outline.size());
  std::vector<glm::vec2> polygon;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const OutlinePoint& p = outline[i];
    const glm::vec2 inner = p.position + inward(outline, i) * bevel;
    mesh.vertices.push_back({frame.point(glm::vec3(p.position, side * (half - bevel))),
                             frame.axes * glm::vec3(p.normal, 0.0F), glm::vec4(0.0F),
                             map(mapping.uv_from_cap, p.position)});
    mesh.vertices.push_back({frame.point(glm::vec3(inner, side * half)), frame.axes * glm::vec3(0, 0, side),
                             glm::vec4(0.0F), map(mapping.uv_from_cap, inner)});
    polygon.push_back(inner);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t outer = first + 2 * i;
    const std::uint32_t next = first + 2 * ((i + 1) % n);
    if (side > 0.0F) {
      add_quad(mesh, outer, next, next + 1, outer + 1);
    } else {
      add_quad(mesh, outer, outer + 1, next + 1, next);
    }
  }
  for (const glm::uvec3& t : triangulate(polygon)) {
    const glm::uvec3 i = first + 2U * t + 1U;
    if (side > 0.0F) {
      add_triangle(mesh, i.x, i.y, i.z);
    } else {
      add_triangle(mesh, i.x, i.z, i.y);
    }
  }
}

}  // namespace

Outline chamfered_rectangle(const glm::vec2& size, float chamfer) {
  const glm::vec2 h = 0.5F * size;
  const glm::vec2 in = h - chamfer;
  return {{{h.x, -in.y}, {1, 0}, -in.y},  {{h.x, in.y}, {1, 0}, in.y},    {{in.x, h.y}, {0, 1}, in.x},
          {{-in.x, h.y}, {0, 1}, -in.x},  {{-h.x, in.y}, {-1, 0}, -in.y}, {{-h.x, -in.y}, {-1, 0}, in.y},
          {{-in.x, -h.y}, {0, -1}, in.x}, {{in.x, -h.y}, {0, -1}, -in.x}};
}

Outline smooth_outline(const std::vector<glm::vec2>& points) {
  constexpr float kSmooth = 0.766F;  // cos 40 degrees
  const std::size_t n = points.size();
  const auto outward = [&](std::size_t i) {  // of the edge from point i
    const glm::vec2 d = glm::normalize(points[(i + 1) % n] - points[i % n]);
    return glm::vec2(d.y, -d.x);
  };
  Outline outline;
  float arc = 0.0F;
  for (std::size_t i = 0; i <= n; ++i) {
    if (i > 0) arc += glm::distance(points[i % n], points[i - 1]);
    const glm::vec2 before = outward(i + n - 1);
    const glm::vec2 after = outward(i);
    const bool smooth = glm::dot(before, after) > kSmooth;
    const glm::vec2 mean = glm::normalize(before + after);
    // The first point comes again at the end, where the texture's strip closes.
    if (i > 0) outline.push_back({points[i % n], smooth ? mean : before, arc});
    if (i < n && (i == 0 || !smooth)) outline.push_back({points[i], smooth ? mean : after, arc});
  }
  return outline;
}

std::vector<glm::uvec3> triangulate(const std::vector<glm::vec2>& polygon) {
  std::vector<std::uint32_t> rest(polygon.size());
  for (std::uint32_t i = 0; i < rest.size(); ++i) rest[i] = i;
  std::vector<glm::uvec3> triangles;
  while (rest.size() > 3) {
    // Of all ears the one with the largest smallest angle keeps slivers away.
    std::size_t best = rest.size();
    float best_quality = -1.0F;
    for (std::size_t k = 0; k < rest.size(); ++k) {
      const glm::vec2& a = polygon[rest[(k + rest.size() - 1) % rest.size()]];
      const glm::vec2& b = polygon[rest[k]];
      const glm::vec2& c = polygon[rest[(k + 1) % rest.size()]];
      const float area = cross(b - a, c - a);
      if (area < -1e-10F) continue;
      bool ear = true;
      for (const std::uint32_t other : rest) ear = ear && !inside(polygon[other], a, b, c);
      const float longest = glm::dot(c - a, c - a) + glm::dot(b - a, b - a) + glm::dot(c - b, c - b);
      const float quality = longest > 0.0F ? std::max(area, 0.0F) / longest : 0.0F;
      if (ear && quality > best_quality) {
        best_quality = quality;
        best = k;
      }
    }
    if (best == rest.size()) throw std::logic_error("an outline crosses itself");
    triangles.emplace_back(rest[(best + rest.size() - 1) % rest.size()], rest[best], rest[(best + 1) % rest.size()]);
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(best));
  }
  triangles.emplace_back(rest[0], rest[1], rest[2]);
  return triangles;
}

void extrude(render::Mesh& mesh, const Outline& outline, float length, float bevel, const Frame& frame,
             const Mapping& mapping) {
  const float half = 0.5F * length;
  add_sides(mesh, outline, half - bevel, frame, mapping);
  add_cap(mesh, outline, half, bevel, -1.0F, frame, mapping);
  add_cap(mesh, outline, half, bevel, 1.0F, frame, mapping);
}

}  // namespace generator
