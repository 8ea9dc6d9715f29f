#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "app/synth/path.h"
#include "app/synth/spec.h"
#include "app/synth/world.h"

namespace app::synth {

// Linear picture as light falls on the sensor: display-linear before the highlights are rolled off.
struct LinearFrame {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> rgb;
};

// Rays through a lens: ideal coordinates (x/z, y/z) of every pixel corner, bilinear between them.
class LensGrid {
 public:
  explicit LensGrid(const ar::CameraModel& camera);
  // (u, v) from the picture's edge (0 ... width); NaN beyond the lens model's range.
  glm::vec2 ideal(float u, float v) const;

 private:
  int width_, height_;
  std::vector<glm::vec2> corners_;  // (width + 1) * (height + 1)
};

// Renders frames of a clip by casting rays over each pixel's area and the shutter's time.
class RayCaster {
 public:
  RayCaster(const Spec& spec, const World& world, const CameraPath& path);
  LinearFrame render(int frame) const;

 private:
  struct Shot;  // where the camera is over one shutter time
  void render_tile(const Shot& shot, int tile_x, int tile_y, LinearFrame& out) const;
  glm::vec3 pixel(const Shot& shot, int x, int y, const Candidates& among) const;
  Radiance sample(const Shot& shot, float u, float v, std::size_t time_slice, const RayFilter& filter,
                  const Candidates& among, Random& random) const;

  const Spec& spec_;
  const World& world_;
  const CameraPath& path_;
  LensGrid lens_;
  float pixel_rad_;  // of the middle of the picture
  float exposure_;
  int strata_;                 // a side of the grid of samples in a pixel
  std::vector<float> inside_;  // inverse distribution of pixel box and blur: offset from the pixel's middle, in pixels
};

}  // namespace app::synth
