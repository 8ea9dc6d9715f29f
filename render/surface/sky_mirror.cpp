#include "render/surface/sky_mirror.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <vector>

#include "render/sky/sky_cube.h"

namespace render {
namespace {

// 5.6 degrees a texel: an unclouded sky is smoother than that, and the mirror's sharpest lobe (shading.glsl allows no
// roughness below 0.06) is a few degrees wide.
constexpr SkyCubeOptions kOptions{.size_px = 32, .levels = 4};

double peak_of(const CubeLevel& level) {
  float peak = 0.0F;
  for (const CubeFace& face : level.face) {
    for (const glm::vec3& rgb : face) peak = std::max({peak, rgb.r, rgb.g, rgb.b});
  }
  return static_cast<double>(peak);
}

}  // namespace

void SkyMirror::update(const SceneState& scene) {
  exposure_ = scene.exposure;
  const glm::dvec3& ground = scene.sky_light.ground_luminance_rgb;
  if (cube_.size() != 0 && scene.sky == sky_ && ground == ground_luminance_rgb_) return;
  sky_ = scene.sky;
  ground_luminance_rgb_ = ground;
  fill();
}

void SkyMirror::fill() {
  const int levels = sky_ ? kOptions.levels : 1;
  const int size = sky_ ? kOptions.size_px : 1;
  if (cube_.levels() != levels) cube_ = gl::CubeTexture(GL_RGB16F, size, levels, "sky mirror");
  if (!sky_) {
    constexpr std::array<float, 3> kBlack{};
    for (int face = 0; face < 6; ++face) cube_.upload(face, 0, GL_RGB, GL_FLOAT, kBlack.data());
    peak_luminance_ = 0.0;
    return;
  }
  std::vector<CubeLevel> cube = make_sky_cube(*sky_, ground_luminance_rgb_, kOptions);
  peak_luminance_ = peak_of(cube.front());
  const auto scale = static_cast<float>(peak_luminance_ > 0.0 ? 1.0 / peak_luminance_ : 0.0);
  for (int level = 0; level < levels; ++level) {
    for (int face = 0; face < 6; ++face) {
      CubeFace& texels = cube[static_cast<std::size_t>(level)].face[static_cast<std::size_t>(face)];
      for (glm::vec3& rgb : texels) rgb *= scale;
      cube_.upload(face, level, GL_RGB, GL_FLOAT, texels.data());
    }
  }
}

void SkyMirror::bind(const gl::Program& program) const {
  program.bind("sky_mirror", cube_.handle());
  program.set("sky_mirror_unit", static_cast<float>(peak_luminance_ * exposure_));
  program.set("sky_mirror_last_level", static_cast<float>(cube_.levels() - 1));
}

}  // namespace render
