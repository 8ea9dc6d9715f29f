#include "render/images/primaries.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace render {

void to_rec709(const Imf::Chromaticities& source, LinearImage& image) {
  if (source == Imf::Chromaticities()) return;
  const Imath::M44f m = Imf::RGBtoXYZ(source, 1.0F) * Imf::XYZtoRGB(Imf::Chromaticities(), 1.0F);
  // Real primaries stay within about 3; what lies on a line or beyond reason gives huge factors or none.
  constexpr float kLargestFactor = 1e4F;
  const bool usable = std::all_of(&m[0][0], &m[0][0] + 16, [](float x) { return std::abs(x) < kLargestFactor; });
  if (!usable) throw std::runtime_error("its chromaticities span no colours");
  for (glm::vec3& rgb : image.rgb) {
    const Imath::V3f out = Imath::V3f(rgb.x, rgb.y, rgb.z) * m;
    rgb = glm::vec3(out.x, out.y, out.z);
  }
}

}  // namespace render
