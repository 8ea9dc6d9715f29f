#include "data/generator/timber.h"

#include <cmath>

#include "data/generator/textures.h"

namespace generator {
namespace {

constexpr float kPi = 3.14159265F;
constexpr float kBandU = 1.0F / WoodSheet::kBands;

// uv = (u0 + metres / band width * band, v0 + metres / length); `turned` swaps the two inputs.
glm::mat3 wood_uv(float u0, float v0, bool turned) {
  const float du = kBandU / WoodSheet::kBandWidth;
  const float dv = 1.0F / WoodSheet::kLength;
  return turned ? glm::mat3(0, dv, 0, du, 0, 0, u0, v0, 1) : glm::mat3(du, 0, 0, 0, dv, 0, u0, v0, 1);
}

}  // namespace

float Timber::band_start() {
  return static_cast<float>(random_.below(WoodSheet::kBands - 1)) * kBandU;
}

void Timber::beam(const glm::vec3& a, const glm::vec3& b, const glm::vec3& side, const glm::vec2& size, float bevel) {
  const glm::vec3 along = glm::normalize(b - a);
  const glm::vec3 x = glm::normalize(side - along * glm::dot(side, along));
  const Frame frame{0.5F * (a + b), glm::mat3(x, glm::cross(along, x), along)};
  const Outline outline = chamfered_rectangle(size, bevel);
  Mapping mapping;
  mapping.uv_from_side = wood_uv(band_start() + 0.5F * kBandU, random_.uniform(0.0F, 1.0F), false);
  const float tile = 0.25F * static_cast<float>(random_.below(4));
  mapping.uv_from_cap = wood_uv(1.0F - 0.5F * kBandU, tile + 0.125F, false);
  mapping.uv_from_cap[1].y = 0.25F / WoodSheet::kBandWidth;
  extrude(mesh_, outline, glm::distance(a, b), std::min(bevel, 0.006F), frame, mapping);
}

void Timber::shaped(const glm::vec3& centre, const glm::vec3& along, const glm::vec3& up,
                    const std::vector<glm::vec2>& outline, float thickness, float bevel) {
  const Frame frame{centre, glm::mat3(along, up, glm::cross(along, up))};
  Mapping mapping;
  const float band = band_start();
  const float v0 = random_.uniform(0.0F, 1.0F);
  mapping.uv_from_side = wood_uv(band + 0.3F * kBandU, v0, true);
  mapping.uv_from_cap = wood_uv(band + 0.5F * kBandU, v0, true);
  extrude(mesh_, smooth_outline(outline), thickness, bevel, frame, mapping);
}

std::vector<glm::vec2> ogee_beam(float length, float height) {
  const float half = 0.5F * length;
  const float top = 0.5F * height;
  // From the bottom edge up to the nose: a hollow, a small step, a round.
  std::vector<glm::vec2> end;
  const float reach = 1.25F * height;
  const float r = 0.42F * height;
  end.emplace_back(half - reach, -top);
  for (int i = 1; i <= 6; ++i) {  // hollow: centre below the beam's edge
    const float a = kPi * (1.0F - static_cast<float>(i) / 12.0F);
    end.emplace_back(half - reach + r + r * std::cos(a), -top + r * std::sin(a));
  }
  const glm::vec2 step = end.back() + glm::vec2(0.06F * height, 0.0F);
  end.push_back(step);
  const glm::vec2 size(half - step.x, 0.36F * height);
  for (int i = 1; i <= 6; ++i) {  // round: a quarter of an ellipse up to the nose
    const float a = kPi * 0.5F * static_cast<float>(i) / 6.0F;
    end.emplace_back(step.x + size.x * std::sin(a), step.y + size.y * (1.0F - std::cos(a)));
  }
  std::vector<glm::vec2> outline = end;
  outline.emplace_back(half, top);
  for (auto p = end.rbegin(); p != end.rend(); ++p) {
    if (p == end.rbegin()) outline.emplace_back(-half, top);
    outline.emplace_back(-p->x, p->y);
  }
  return outline;
}

int add_wood(render::Model& model) {
  const auto first = static_cast<int>(model.images.size());
  for (render::Image& image : wood_textures()) model.images.push_back(std::move(image));
  render::Material wood;
  wood.name = "larch";
  wood.metallic = 0.0F;
  wood.base_color_texture.image = first;
  wood.normal_texture.image = first + 1;
  wood.metallic_roughness_texture.image = first + 2;
  model.materials.push_back(wood);
  return static_cast<int>(model.materials.size()) - 1;
}

}  // namespace generator
