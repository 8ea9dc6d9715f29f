#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "render/images/image_io.h"

namespace render {

// What a medium adds to and takes from a picture, upsampled to its size. Row 0 at the top.
struct MediumImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> rgba;  // in-scattered luminance_rgb in cd/m2, not exposed; transmittance
  // Metres along the camera's axis to what is seen, 1e9 and more: nothing. Empty where the technique's own picture is
  // smaller.
  std::vector<float> axis_distance_m;

  LinearImage in_scattered() const;
  LinearImage transmittance() const;  // grey
};

}  // namespace render
