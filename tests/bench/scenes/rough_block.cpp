#include "tests/bench/scenes/rough_block.h"

#include <array>

#include "data/generator/noise.h"

namespace bench_scenes {
namespace {

// The faces of a box: along u, along v, outwards, with u x v outwards.
struct Face {
  glm::vec3 u, v, out;
};
const std::array<Face, 6> kFaces{{{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}},
                                  {{0, -1, 0}, {0, 0, 1}, {-1, 0, 0}},
                                  {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                  {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                  {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                  {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};

float bump(const glm::vec3& p, std::uint32_t seed) {
  const auto at = [&](const glm::vec2& q, std::uint32_t layer) {
    return generator::noise(q, {4096, 4096}, seed + layer);
  };
  return (at({p.x, p.y}, 0) + at({p.y, p.z}, 1) + at({p.z, p.x}, 2)) / 3.0F;
}

// Places along an edge: dense at both ends, where it is rounded.
float spread(int i, int cells) {
  const float t = 2.0F * static_cast<float>(i) / static_cast<float>(cells) - 1.0F;
  return t * (1.5F - 0.5F * t * t);
}

// A point of the box's surface, pulled in to the rounded edge, then pushed by the noise.
glm::vec3 shaped(const RoughBlock& block, const glm::vec3& unit) {
  const glm::vec3 half = 0.5F * block.size;
  const glm::vec3 inner = half - glm::vec3(block.round);
  const glm::vec3 at = unit * half;
  const glm::vec3 core = glm::clamp(at, -inner, inner);
  const glm::vec3 away = at - core;
  const float length = glm::length(away);
  const glm::vec3 direction = length > 0.0F ? away / length : unit;
  return core + direction * (block.round + block.bulge * bump(7.0F * at + 40.0F, block.seed));
}

}  // namespace

void add_block(render::Mesh& mesh, const RoughBlock& block) {
  const glm::vec2 own(static_cast<float>(block.seed % 97U) / 97.0F, static_cast<float>(block.seed % 89U) / 89.0F);
  for (const Face& face : kFaces) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto row = static_cast<std::uint32_t>(block.cells + 1);
    for (int j = 0; j <= block.cells; ++j) {
      for (int i = 0; i <= block.cells; ++i) {
        const float u = spread(i, block.cells);
        const float v = spread(j, block.cells);
        const auto point = [&](float a, float b) { return shaped(block, face.out + a * face.u + b * face.v); };
        constexpr float kStep = 0.02F;
        const glm::vec3 p = point(u, v);
        const glm::vec3 du = point(glm::min(u + kStep, 1.0F), v) - point(glm::max(u - kStep, -1.0F), v);
        const glm::vec3 dv = point(u, glm::min(v + kStep, 1.0F)) - point(u, glm::max(v - kStep, -1.0F));
        const glm::vec2 in_face(glm::dot(p, face.u), -glm::dot(p, face.v));
        mesh.vertices.push_back({block.centre + block.axes * p, glm::normalize(block.axes * glm::cross(du, dv)),
                                 glm::vec4(0.0F), in_face / 0.4F + own});
      }
    }
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
      for (std::uint32_t i = 0; i + 1 < row; ++i) {
        const std::uint32_t a = first + j * row + i;
        mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + row + 1, a, a + row + 1, a + row});
      }
    }
  }
}

void add_box(render::Mesh& mesh, const glm::vec3& low, const glm::vec3& high, float tile_m) {
  const glm::vec3 centre = 0.5F * (low + high);
  const glm::vec3 half = 0.5F * (high - low);
  for (const Face& face : kFaces) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      const glm::vec3 p = centre + half * (face.out + corner.x * face.u + corner.y * face.v);
      mesh.vertices.push_back(
          {p, face.out, glm::vec4(0.0F), glm::vec2(glm::dot(p, face.u), -glm::dot(p, face.v)) / tile_m});
    }
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + i);
  }
}

}  // namespace bench_scenes
