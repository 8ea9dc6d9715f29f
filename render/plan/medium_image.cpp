#include "render/plan/medium_image.h"

namespace render {

LinearImage MediumImage::in_scattered() const {
  return {width, height, std::vector<glm::vec3>(rgba.begin(), rgba.end())};
}

LinearImage MediumImage::transmittance() const {
  LinearImage image{width, height, {}};
  for (const glm::vec4& pixel : rgba) image.rgb.emplace_back(pixel.a);
  return image;
}

}  // namespace render
