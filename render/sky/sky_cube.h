#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "render/sky/sky_model.h"

namespace render {

// One face of a cube, row 0 first, as GL wants its texels.
using CubeFace = std::vector<glm::vec3>;

// What a rough mirror of one roughness sees: the mean luminance in cd/m2 around each direction, weighted as by GGX seen
// along its normal.
struct CubeLevel {
  int size_px = 0;
  double roughness = 0.0;          // alpha = roughness squared
  std::array<CubeFace, 6> face{};  // +x -x +y -y +z -z of the world (east, north, up), as GL_TEXTURE_CUBE_MAP_*
};

struct SkyCubeOptions {
  int size_px = 64;  // of the first level's faces, a power of two, 8 or more
  int levels = 5;    // each half as large as the one before: at most as many as there are halves down to 4
};

// A sky as mirrors of growing roughness see it, evenly spaced from 0 to 1: level i holds roughness i / (levels - 1).
// Below the horizon stands `ground_luminance_rgb`. The sun's disc is not in it. Each level keeps the mean luminance of
// the whole sphere, so that no light is gained or lost (Karis 2013, "Real Shading in Unreal Engine 4", the first half
// of the split sum; multiply by the second half, the specular reflectance). Throws std::invalid_argument for sizes
// that do not fit.
std::vector<CubeLevel> make_sky_cube(const SkyModel& sky, const glm::dvec3& ground_luminance_rgb,
                                     const SkyCubeOptions& options = {});

// Unit direction of a point of a face; column and row in texels from the face's edge, so that a texel's middle has .5.
glm::dvec3 cube_direction(int face, double column, double row, int size_px);

// Solid angle of a texel.
double cube_texel_sr(int column, int row, int size_px);

}  // namespace render
