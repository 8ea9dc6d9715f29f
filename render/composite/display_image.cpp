#include "render/composite/display_image.h"

#include <cmath>

#include "render/composite/picture_math.h"

namespace render {

Image display_image(const LinearImage& linear, double exposure) {
  Image image{linear.width, linear.height, {}};
  image.rgba.resize(linear.rgb.size() * 4);
  const float scale = static_cast<float>(exposure);
  std::size_t i = 0;
  for (int y = 0; y < linear.height; ++y) {
    for (int x = 0; x < linear.width; ++x, ++i) {
      const glm::vec3 shown = glm::min(shoulder(linear.rgb[i] * scale), glm::vec3(1.0F));
      const glm::vec3 code = coded_from_linear(Transfer::Srgb, glm::max(shown, glm::vec3(0.0F))) * 255.0F;
      const glm::vec3 stepped = glm::floor(code + 0.5F + 0.96F * dither(glm::vec2(x, y)));
      for (int c = 0; c < 3; ++c) {
        image.rgba[4 * i + static_cast<std::size_t>(c)] =
            static_cast<std::uint8_t>(std::fmin(std::fmax(stepped[c], 0.0F), 255.0F));
      }
      image.rgba[4 * i + 3] = 255;
    }
  }
  return image;
}

}  // namespace render
