#include "data/generator/solids.h"

#include <cmath>

namespace generator {
namespace {

constexpr float kTau = 6.2831853F;

glm::vec3 orthogonal(const glm::vec3& v) {
  const glm::vec3 other = std::abs(v.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  return glm::normalize(glm::cross(v, other));
}

// Rows of `columns` vertices joined to quads; rows upwards, columns counter-clockwise seen from above.
void join_rows(render::Mesh& mesh, std::uint32_t first, std::uint32_t rows, std::uint32_t columns) {
  for (std::uint32_t r = 0; r + 1 < rows; ++r) {
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t a = first + r * columns + c;
      for (const glm::uvec3 t : {glm::uvec3(a, a + 1, a + columns + 1), glm::uvec3(a, a + columns + 1, a + columns)}) {
        const glm::vec3& p = mesh.vertices[t.x].position;
        const glm::vec3 face = glm::cross(mesh.vertices[t.y].position - p, mesh.vertices[t.z].position - p);
        if (glm::length(face) > 1e-9F) mesh.indices.insert(mesh.indices.end(), {t.x, t.y, t.z});
      }
    }
  }
}

struct ProfilePoint {
  glm::vec2 position;
  glm::vec2 normal;
  float arc;
};

// Profile points with normals (to the right of its direction); two where it turns sharply.
std::vector<ProfilePoint> with_normals(const std::vector<glm::vec2>& profile) {
  constexpr float kSmooth = 0.82F;  // cos 35 degrees
  std::vector<ProfilePoint> points;
  float arc = 0.0F;
  const auto right = [&](std::size_t i) {
    const glm::vec2 d = glm::normalize(profile[i + 1] - profile[i]);
    return glm::vec2(d.y, -d.x);
  };
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (i > 0) arc += glm::distance(profile[i], profile[i - 1]);
    const glm::vec2 before = right(i == 0 ? 0 : i - 1);
    const glm::vec2 after = right(i + 1 == profile.size() ? i - 1 : i);
    if (glm::dot(before, after) > kSmooth) {
      points.push_back({profile[i], glm::normalize(before + after), arc});
    } else {
      points.push_back({profile[i], before, arc});
      points.push_back({profile[i], after, arc});
    }
  }
  return points;
}

}  // namespace

void lathe(render::Mesh& mesh, const glm::vec3& centre, const std::vector<glm::vec2>& profile, int sides,
           float tile_m) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::vector<ProfilePoint> points = with_normals(profile);
  float widest = 0.0F;
  for (const glm::vec2& p : profile) widest = std::max(widest, p.x);
  const float turns = std::max(1.0F, std::round(kTau * widest / tile_m));  // whole tiles around: no seam
  for (const ProfilePoint& p : points) {
    for (int i = 0; i <= sides; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(sides);
      const glm::vec2 round(std::cos(kTau * t), std::sin(kTau * t));
      mesh.vertices.push_back({centre + glm::vec3(round * p.position.x, p.position.y),
                               glm::vec3(round * p.normal.x, p.normal.y),
                               glm::vec4(0.0F),
                               {t * turns, -p.arc / tile_m}});
    }
  }
  join_rows(mesh, first, static_cast<std::uint32_t>(points.size()), static_cast<std::uint32_t>(sides + 1));
}

void tube(render::Mesh& mesh, const std::vector<glm::vec3>& points, const std::vector<float>& radii, int sides,
          float tile_m) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  float arc = 0.0F;
  glm::vec3 x = orthogonal(glm::normalize(points[1] - points[0]));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const glm::vec3 from = points[k == 0 ? 0 : k - 1];
    const glm::vec3 to = points[std::min(k + 1, points.size() - 1)];
    const glm::vec3 along = glm::normalize(to - from);
    x = glm::normalize(x - along * glm::dot(x, along));  // carried along without twist
    const glm::vec3 y = glm::cross(along, x);
    if (k > 0) arc += glm::distance(points[k], points[k - 1]);
    for (int i = 0; i <= sides; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(sides);
      const glm::vec3 round = x * std::cos(kTau * t) + y * std::sin(kTau * t);
      mesh.vertices.push_back({points[k] + round * radii[k], round, glm::vec4(0.0F), {t, -arc / tile_m}});
    }
  }
  join_rows(mesh, first, static_cast<std::uint32_t>(points.size()), static_cast<std::uint32_t>(sides + 1));
}

void leaf_card(render::Mesh& mesh, const Card& card) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const glm::vec3 across = glm::normalize(glm::cross(card.along, card.facing));
  const glm::vec3 face = glm::cross(across, card.along);
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 3; ++column) {
      const float s = 0.5F * static_cast<float>(column - 1);
      const glm::vec3 fold = face * (column == 1 ? 0.0F : 0.10F * card.size);
      const glm::vec3 droop = -face * (row == 1 ? 0.12F * card.size : 0.0F);
      const glm::vec3 normal = glm::normalize(face - 0.7F * s * across + 0.8F * card.outward);
      mesh.vertices.push_back(
          {card.foot + across * (s * card.size) + card.along * (static_cast<float>(row) * card.size) + fold + droop,
           normal, glm::vec4(0.0F), card.uv + card.uv_size * glm::vec2(0.5F + s, 1.0F - static_cast<float>(row))});
    }
  }
  join_rows(mesh, first, 2, 3);
}

void lemon(render::Mesh& mesh, const glm::vec3& centre, const glm::vec3& axis, float radius, int rings, int sides) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const glm::vec3 x = orthogonal(axis);
  const glm::vec3 y = glm::cross(axis, x);
  const auto radius_at = [&](float t) {
    const float bulge = std::sin(0.5F * kTau * t);
    return radius * std::pow(bulge, 0.9F);
  };
  const auto height_at = [&](float t) {
    const float nipple = 0.22F * std::pow(t, 10.0F) - 0.10F * std::pow(1.0F - t, 10.0F);
    return radius * (-1.22F * std::cos(0.5F * kTau * t) + nipple);
  };
  for (int r = 0; r <= rings; ++r) {
    const float t = static_cast<float>(r) / static_cast<float>(rings);
    const float step = 0.01F;
    const float below = std::max(0.0F, t - step);
    const float above = std::min(1.0F, t + step);
    const glm::vec2 slope(radius_at(above) - radius_at(below), height_at(above) - height_at(below));
    const glm::vec2 n = r == 0       ? glm::vec2(0, -1)
                        : r == rings ? glm::vec2(0, 1)
                                     : glm::normalize(glm::vec2(slope.y, -slope.x));
    const float ring = r == 0 || r == rings ? 0.0F : radius_at(t);
    for (int i = 0; i <= sides; ++i) {
      const float a = kTau * static_cast<float>(i) / static_cast<float>(sides);
      const glm::vec3 round = x * std::cos(a) + y * std::sin(a);
      mesh.vertices.push_back({centre + round * ring + axis * height_at(t),
                               round * n.x + axis * n.y,
                               glm::vec4(0.0F),
                               {a / kTau, 1.0F - t}});
    }
  }
  join_rows(mesh, first, static_cast<std::uint32_t>(rings + 1), static_cast<std::uint32_t>(sides + 1));
}

}  // namespace generator
