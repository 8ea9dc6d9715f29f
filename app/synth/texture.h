#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace app::synth {

// What a texture tells of one place of a surface, linear.
struct SurfacePoint {
  glm::vec3 albedo{0.5F};
  float sky_seen = 1.0F;  // share of the sky that its own relief leaves open
  glm::vec2 slope{0.0F};  // -dh/du, -dh/dv: the normal is normalize(slope, 1)
  float sun_seen = 1.0F;  // share of the sun that its own relief leaves
  float gloss = 0.0F;     // strength of a rough mirror-like share, 0..1
};

// A square texture with mip levels, eight bytes a texel. Baked once, read by every sample.
class Texture {
 public:
  Texture() = default;
  // `points`: size * size, row 0 at v = 0. `size` a power of two; `metres` is the side's length in the world.
  Texture(int size, float metres, const std::vector<SurfacePoint>& points);

  float metres() const { return metres_; }
  bool empty() const { return levels_.empty(); }
  // At (u, v) in metres, repeating, filtered bilinearly on the level whose texels are nearest to `footprint_m`, rounded
  // up or down by `dither` in [0, 1), so that levels blend in the mean of the samples.
  SurfacePoint sample(glm::vec2 uv_m, float footprint_m, float dither) const;

 private:
  using Texel = std::array<std::uint8_t, 8>;
  struct Level {
    int size = 0;
    std::vector<Texel> texels;
  };
  static Texel encode(const SurfacePoint& point);

  float metres_ = 1.0F;
  std::vector<Level> levels_;
};

}  // namespace app::synth
