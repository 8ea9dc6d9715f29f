#include "render/sky/sky_cube.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>
#include <string>

namespace render {
namespace {

constexpr int kSmallestFace = 4;

// A texel as a small light.
struct Texel {
  glm::vec3 direction;
  float solid_angle_sr;
  glm::vec3 luminance_rgb;
};

std::size_t texel_index(int column, int row, int size) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(size) + static_cast<std::size_t>(column);
}

template <typename Value>
CubeLevel fill(int size, double roughness, const Value& value) {
  CubeLevel level{size, roughness, {}};
  for (int face = 0; face < 6; ++face) {
    CubeFace& texels = level.face[static_cast<std::size_t>(face)];
    texels.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) texels.push_back(value(face, column, row));
    }
  }
  return level;
}

// Four samples a texel, so that horizon and aureole do not step.
CubeLevel mirror(const SkyModel& sky, const glm::dvec3& ground_luminance_rgb, int size) {
  return fill(size, 0.0, [&](int face, int column, int row) {
    glm::dvec3 sum(0.0);
    for (const double y : {0.25, 0.75}) {
      for (const double x : {0.25, 0.75}) {
        const glm::dvec3 direction = cube_direction(face, column + x, row + y, size);
        sum += direction.z < 0.0 ? ground_luminance_rgb : sky.luminance_rgb(direction);
      }
    }
    return glm::vec3(sum * 0.25);
  });
}

// Half the size, four texels in one, by their solid angles.
CubeLevel halved(const CubeLevel& level) {
  return fill(level.size_px / 2, level.roughness, [&](int face, int column, int row) {
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for (const int j : {2 * row, 2 * row + 1}) {
      for (const int i : {2 * column, 2 * column + 1}) {
        const double solid_angle = cube_texel_sr(i, j, level.size_px);
        const glm::vec3& rgb = level.face[static_cast<std::size_t>(face)][texel_index(i, j, level.size_px)];
        sum += glm::dvec3(rgb) * solid_angle;
        weight += solid_angle;
      }
    }
    return glm::vec3(sum / weight);
  });
}

std::vector<Texel> texels_of(const CubeLevel& level) {
  std::vector<Texel> texels;
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < level.size_px; ++row) {
      for (int column = 0; column < level.size_px; ++column) {
        texels.push_back({glm::vec3(cube_direction(face, column + 0.5, row + 0.5, level.size_px)),
                          static_cast<float>(cube_texel_sr(column, row, level.size_px)),
                          level.face[static_cast<std::size_t>(face)][texel_index(column, row, level.size_px)]});
      }
    }
  }
  return texels;
}

// GGX for a view along the normal, over the reflected direction: D(h) (n.l) without its constant factor. The half
// vector stands half as far from the normal, so that cos^2 = (1 + cosine) / 2.
float ggx_lobe(float cosine, float alpha2) {
  const float spread = 0.5F * (1.0F + cosine) * (alpha2 - 1.0F) + 1.0F;
  return cosine / (spread * spread);
}

// Directions that are looked around in at once, without a branch, so that compilers vectorise it: this is nearly all of
// the time that a cube takes.
constexpr int kLanes = 8;
struct Lanes {
  std::array<float, kLanes> x{}, y{}, z{};
  std::array<float, kLanes> red{}, green{}, blue{};
  std::array<float, kLanes> weights{};
};

Lanes look_around(const std::vector<Texel>& texels, float alpha2, Lanes lanes) {
  for (const Texel texel : texels) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float cosine =
          texel.direction.x * lanes.x[k] + texel.direction.y * lanes.y[k] + texel.direction.z * lanes.z[k];
      const float weight = ggx_lobe(0.5F * (cosine + std::abs(cosine)), alpha2) * texel.solid_angle_sr;
      lanes.red[k] += texel.luminance_rgb.r * weight;
      lanes.green[k] += texel.luminance_rgb.g * weight;
      lanes.blue[k] += texel.luminance_rgb.b * weight;
      lanes.weights[k] += weight;
    }
  }
  return lanes;
}

glm::dvec3 total(const CubeLevel& level) {
  glm::dvec3 sum(0.0);
  for (const Texel& texel : texels_of(level)) {
    sum += glm::dvec3(texel.luminance_rgb) * static_cast<double>(texel.solid_angle_sr);
  }
  return sum;
}

// Texels lie unevenly on the sphere: what that gains or loses of the whole, a part in a thousand, is given back.
void keep_total(CubeLevel& level, const glm::dvec3& wanted) {
  const glm::dvec3 found = total(level);
  glm::vec3 factor(1.0F);
  for (int c = 0; c < 3; ++c) factor[c] = found[c] > 0.0 ? static_cast<float>(wanted[c] / found[c]) : 1.0F;
  for (CubeFace& face : level.face) {
    for (glm::vec3& rgb : face) rgb *= factor;
  }
}

CubeLevel roughened(const CubeLevel& source, int size, double roughness) {
  static_assert(kSmallestFace * kSmallestFace % kLanes == 0, "a face's texels fill the lanes");
  const std::vector<Texel> texels = texels_of(source);
  const auto alpha2 = static_cast<float>(std::pow(roughness, 4.0));
  // Directions first, then what is seen there.
  CubeLevel level = fill(size, roughness, [&](int face, int column, int row) {
    return glm::vec3(cube_direction(face, column + 0.5, row + 0.5, size));
  });
  for (CubeFace& face : level.face) {
    for (std::size_t first = 0; first < face.size(); first += kLanes) {
      Lanes lanes;
      for (std::size_t k = 0; k < kLanes; ++k) {
        lanes.x[k] = face[first + k].x;
        lanes.y[k] = face[first + k].y;
        lanes.z[k] = face[first + k].z;
      }
      lanes = look_around(texels, alpha2, lanes);
      for (std::size_t k = 0; k < kLanes; ++k) {
        face[first + k] = glm::vec3(lanes.red[k], lanes.green[k], lanes.blue[k]) / lanes.weights[k];
      }
    }
  }
  return level;
}

void check(const SkyCubeOptions& options) {
  const int size = options.size_px;
  if (size < 8 || size > 1024 || (size & (size - 1)) != 0) {
    throw std::invalid_argument("a sky cube's faces must be a power of two from 8 to 1024, found " +
                                std::to_string(size));
  }
  if (options.levels < 2 || size >> (options.levels - 1) < kSmallestFace) {
    throw std::invalid_argument("a sky cube of " + std::to_string(size) + " texels has 2 levels or more down to " +
                                std::to_string(kSmallestFace) + " texels, found " + std::to_string(options.levels));
  }
}

}  // namespace

glm::dvec3 cube_direction(int face, double column, double row, int size_px) {
  const double s = 2.0 * column / size_px - 1.0;
  const double t = 2.0 * row / size_px - 1.0;
  switch (face) {  // OpenGL ES 3.2, table 8.19
    case 0:
      return glm::normalize(glm::dvec3(1.0, -t, -s));
    case 1:
      return glm::normalize(glm::dvec3(-1.0, -t, s));
    case 2:
      return glm::normalize(glm::dvec3(s, 1.0, t));
    case 3:
      return glm::normalize(glm::dvec3(s, -1.0, -t));
    case 4:
      return glm::normalize(glm::dvec3(s, -t, 1.0));
    default:
      return glm::normalize(glm::dvec3(-s, -t, -1.0));
  }
}

double cube_texel_sr(int column, int row, int size_px) {
  const auto corner = [size_px](int i, int j) {
    const double x = 2.0 * i / size_px - 1.0;
    const double y = 2.0 * j / size_px - 1.0;
    return std::atan2(x * y, std::sqrt(x * x + y * y + 1.0));
  };
  return corner(column, row) - corner(column, row + 1) - corner(column + 1, row) + corner(column + 1, row + 1);
}

std::vector<CubeLevel> make_sky_cube(const SkyModel& sky, const glm::dvec3& ground_luminance_rgb,
                                     const SkyCubeOptions& options) {
  check(options);
  std::vector<CubeLevel> levels{mirror(sky, ground_luminance_rgb, options.size_px)};
  const glm::dvec3 wanted = total(levels.front());
  CubeLevel source = levels.front();
  for (int i = 1; i < options.levels; ++i) {
    // A level is filtered from the sky at twice its own size: finer detail than its lobe can tell apart is not needed.
    while (source.size_px > 32 || source.size_px > 2 * (options.size_px >> i)) source = halved(source);
    CubeLevel level = roughened(source, options.size_px >> i, static_cast<double>(i) / (options.levels - 1));
    keep_total(level, wanted);
    levels.push_back(std::move(level));
  }
  return levels;
}

}  // namespace render
