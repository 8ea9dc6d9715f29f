#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "app/synth/gaze.h"
#include "app/synth/light.h"
#include "app/synth/noise.h"
#include "app/synth/plants.h"
#include "app/synth/spec.h"

namespace app::synth {

// Everything too far away to shift when the camera moves: sky, thin cloud, hills, a line of trees. A panorama in
// azimuth and elevation, baked once, where it can be seen.
class Backdrop {
 public:
  Backdrop(const Spec& spec, const Light& light, const Gaze& gaze);
  // cd/m2 in that unit direction; below the horizon the air in front of far ground.
  glm::vec3 luminance(const glm::vec3& direction) const;

 private:
  glm::vec3 sky(float azimuth, float elevation) const;
  void find_seen_columns(const Gaze& gaze);
  void bake_sky(const Spec& spec, const Light& light);
  void bake_hills(const Spec& spec, const Light& light);
  void bake_meadow(const Spec& spec, const Light& light);
  void bake_trees(const Spec& spec, const Light& light);
  struct TreeStand;
  static int column_at(float azimuth);
  std::vector<TreeStand> stands_about(float middle, std::uint32_t seed, Random& random) const;
  void draw_tree(const TreeStand& stand, const Painting& tree, const glm::vec3& air);
  glm::vec3& texel(int x, int y) { return panorama_[static_cast<std::size_t>(y * kWidth + x)]; }

  static constexpr int kWidth = 8192;  // over 360 degrees
  static constexpr int kHeight = 910;  // over 40 degrees, the same scale
  static constexpr int kBelow = 46;    // rows below the horizon
  static constexpr int kSkyWidth = 512;
  static constexpr int kSkyHeight = 129;  // over 90 degrees
  std::vector<glm::vec3> sky_;            // coarse, row 0 at the horizon
  std::vector<std::uint8_t> seen_;        // by column of the panorama
  std::vector<glm::vec3> panorama_;       // row 0 at -2 degrees
};

}  // namespace app::synth
