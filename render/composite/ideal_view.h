#pragma once

#include <vector>

#include "render/base/rectangle.h"
#include "render/gl/texture.h"
#include "render/scene/scene_state.h"
#include "render/scene/view.h"

namespace render {

// Farthest angle off the camera's axis that a pinhole picture is asked to show.
inline constexpr double kWidestOffAxisRad = 1.3962634015954636;  // 80 degrees

// The pinhole picture that the objects pass draws for that camera: the camera's own without a lens; else one that
// covers all ideal coordinates of the lens map (up to kWidestOffAxisRad, logged) with the same resolution in the
// centre, at most `kLargestIdealPx` wide and high. Throws std::runtime_error where the map has no finite pixel or
// another size than the camera.
// `scale` in (0, 1]: that much smaller.
inline constexpr int kLargestIdealPx = 4096;
View ideal_view(const Camera& camera, double scale = 1.0);

// Moves a view to the camera's pose and keeps its picture geometry.
void look_from(const Camera& camera, View& view);

// The lens map as the composite pass needs it: each pixel's place in the ideal picture.
class LensLookup {
 public:
  LensLookup(const LensMap& map, const View& view);

  const gl::Texture& texture() const { return texture_; }  // RG32F, 0 to 1 from the ideal picture's top left; -1: none
  // The smallest rectangle of whole cells of the real picture whose pixels look into `ideal`, one pixel of slack
  // included.
  PixelRect real_from_ideal(const PixelRect& ideal) const;

 private:
  struct Cell {
    glm::vec2 min_px;  // ideal pixels that the cell's pixels look at
    glm::vec2 max_px;
  };

  int width_ = 0;
  int height_ = 0;
  int columns_ = 0;
  std::vector<Cell> cells_;
  gl::Texture texture_;
};

}  // namespace render
