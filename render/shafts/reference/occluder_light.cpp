#include "render/shafts/reference/occluder_light.h"

#include <algorithm>
#include <cmath>

namespace render {
namespace {

// What blended material of that colour and opacity lets through: its own colour where it is thin, nothing where it is
// opaque.
glm::dvec3 blended_transmission(const glm::dvec3& rgb, double alpha) {
  return (1.0 - alpha) * glm::mix(glm::dvec3(1.0), rgb, alpha);
}

// glTF's wrapping of a texel index.
int wrapped(int i, int size, TextureWrap wrap) {
  switch (wrap) {
    case TextureWrap::Clamp:
      return std::clamp(i, 0, size - 1);
    case TextureWrap::Repeat:
      return (i % size + size) % size;
    case TextureWrap::Mirror:
      break;
  }
  const int at = (i % (2 * size) + 2 * size) % (2 * size);
  return at < size ? at : 2 * size - 1 - at;
}

// The base colour's texture as the GPU filters it: bilinear, of level 0, 0 to 1, alpha linear.
class Texels {
 public:
  Texels(const Image& image, TextureWrap wrap) : image_(image), wrap_(wrap) {}

  // Coordinates in which the centres of texels are whole numbers.
  glm::dvec2 at(const glm::dvec2& uv) const { return {uv.x * image_.width - 0.5, uv.y * image_.height - 0.5}; }

  glm::dvec4 bilinear(const glm::dvec2& at) const {
    const glm::dvec2 base = glm::floor(at);
    const glm::dvec2 part = at - base;
    const int x = static_cast<int>(base.x);
    const int y = static_cast<int>(base.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), part.x),
                    glm::mix(texel(x, y + 1), texel(x + 1, y + 1), part.x), part.y);
  }

 private:
  static double linear(double coded) {
    return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
  }

  glm::dvec4 texel(int x, int y) const {
    const auto index =
        4U * (static_cast<std::size_t>(wrapped(y, image_.height, wrap_)) * static_cast<std::size_t>(image_.width) +
              static_cast<std::size_t>(wrapped(x, image_.width, wrap_)));
    const auto channel = [&](std::size_t i) { return image_.rgba[index + i] / 255.0; };
    return {linear(channel(0)), linear(channel(1)), linear(channel(2)), channel(3)};
  }

  const Image& image_;
  TextureWrap wrap_;
};

// Places in (0, 1) at which from + s (to - from) passes a whole number: there the bilinear patch changes.
void add_crossings(double from, double to, std::vector<double>& places) {
  const double size = to - from;
  if (size == 0.0) return;
  const double last = std::max(from, to);
  for (double line = std::floor(std::min(from, to)) + 1.0; line < last; line += 1.0) {
    places.push_back((line - from) / size);
  }
}

// Roots in (0, 1) of the parabola through (0, y0), (1/2, y1), (1, y2).
void add_roots(double y0, double y1, double y2, double from, double size, std::vector<double>& places) {
  const double a = 2.0 * (y0 - 2.0 * y1 + y2);
  const double b = -3.0 * y0 + 4.0 * y1 - y2;
  const double discriminant = b * b - 4.0 * a * y0;
  if (discriminant < 0.0) return;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  for (const double root : {a != 0.0 ? q / a : -1.0, q != 0.0 ? y0 / q : -1.0}) {
    if (root > 0.0 && root < 1.0) places.push_back(from + root * size);
  }
}

}  // namespace

void let_through(const OccluderTriangle& triangle, const glm::dvec2& uv_from, const glm::dvec2& uv_to,
                 std::vector<LetThrough>& pieces) {
  pieces.clear();
  const Material& material = *triangle.material;
  const glm::dvec4 factor(material.base_color);
  const auto light = [&](const glm::dvec4& base) {
    if (material.alpha_mode == AlphaMode::Mask) return glm::dvec3(base.a < material.alpha_cutoff ? 1.0 : 0.0);
    return blended_transmission(glm::dvec3(base), base.a);
  };
  if (material.base_color_texture.image < 0) {
    pieces.push_back({.rgb = light(factor)});
    return;
  }
  const Texels texels(triangle.model->images[static_cast<std::size_t>(material.base_color_texture.image)],
                      material.base_color_texture.wrap);
  const glm::dvec2 from = texels.at(uv_from);
  const glm::dvec2 to = texels.at(uv_to);
  const auto base = [&](double s) { return factor * texels.bilinear(glm::mix(from, to, s)); };
  std::vector<double> places{0.0, 1.0};
  add_crossings(from.x, to.x, places);
  add_crossings(from.y, to.y, places);
  std::ranges::sort(places);
  if (material.alpha_mode == AlphaMode::Mask) {
    const std::size_t patches = places.size() - 1;
    for (std::size_t i = 0; i < patches; ++i) {
      const double a = places[i];
      const double b = places[i + 1];
      const double cutoff = material.alpha_cutoff;
      add_roots(base(a).a - cutoff, base(0.5 * (a + b)).a - cutoff, base(b).a - cutoff, a, b - a, places);
    }
    std::ranges::sort(places);
  }
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    if (places[i + 1] <= places[i]) continue;
    pieces.push_back({.from = places[i], .to = places[i + 1], .rgb = light(base(0.5 * (places[i] + places[i + 1])))});
  }
}

}  // namespace render
