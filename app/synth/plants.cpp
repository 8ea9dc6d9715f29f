#include "app/synth/plants.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/synth/noise.h"
#include "app/synth/plant_growth.h"

namespace app::synth {
namespace {

// Where the leaves are dense; light on its way in is attenuated by it.
class Density {
 public:
  Density(const std::vector<Leaf>& leaves, float height_m, float width_m)
      : low_(-0.6F * width_m, -0.6F * width_m, 0.0F),
        size_(1.2F * width_m, 1.2F * width_m, 1.1F * height_m),
        cells_(static_cast<std::size_t>(kSide) * kSide * kSide, 0.0F) {
    const glm::vec3 cell = size_ / static_cast<float>(kSide);
    const float volume = cell.x * cell.y * cell.z;
    for (const Leaf& leaf : leaves) {
      if (float* const at = find(leaf.place)) *at += 1.6F * glm::length(leaf.along) * leaf.half_width_m / volume;
    }
  }
  // Share of light that comes to `from` along `direction`: leaf area density times 1/2, Beer's law.
  float open(glm::vec3 from, const glm::vec3& direction) const {
    constexpr int kSteps = 14;
    const float step = 0.75F * size_.x / static_cast<float>(kSteps);
    float depth = 0.0F;
    for (int i = 0; i < kSteps; ++i) {
      from += direction * step;
      if (const float* const at = const_cast<Density*>(this)->find(from)) depth += *at * step;
    }
    return std::exp(-0.5F * depth);
  }

 private:
  static constexpr int kSide = 40;
  float* find(const glm::vec3& p) {
    const glm::vec3 g = (p - low_) / size_ * static_cast<float>(kSide);
    if (g.x < 0.0F || g.y < 0.0F || g.z < 0.0F || g.x >= kSide || g.y >= kSide || g.z >= kSide) return nullptr;
    return &cells_[static_cast<std::size_t>((static_cast<int>(g.z) * kSide + static_cast<int>(g.y)) * kSide +
                                            static_cast<int>(g.x))];
  }
  glm::vec3 low_;
  glm::vec3 size_;
  std::vector<float> cells_;
};

// One leaf as a soft-edged ellipse over what is already there.
void splat(Painting& canvas, glm::vec2 centre, glm::vec2 along, float half_width, const glm::vec3& radiance) {
  const float length = std::max(glm::length(along), 0.35F);
  const glm::vec2 axis = glm::length(along) > 1e-4F ? along / glm::length(along) : glm::vec2(0.0F, 1.0F);
  const float thin = std::max(half_width, 0.30F);
  const float cover = std::min(1.0F, half_width / thin * (0.35F + 0.65F * glm::length(along) / length));
  const float reach = std::max(length, thin) + 1.0F;
  const int x0 = std::max(0, static_cast<int>(centre.x - reach));
  const int x1 = std::min(canvas.width - 1, static_cast<int>(centre.x + reach));
  const int y0 = std::max(0, static_cast<int>(centre.y - reach));
  const int y1 = std::min(canvas.height - 1, static_cast<int>(centre.y + reach));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const glm::vec2 d = glm::vec2(x, y) + 0.5F - centre;
      const float a = glm::dot(d, axis) / length;
      const float b = (d.x * -axis.y + d.y * axis.x) / thin;
      const float inside = (1.0F - std::sqrt(a * a + b * b)) * thin;
      const float alpha = cover * glm::clamp(inside + 0.5F, 0.0F, 1.0F);
      if (alpha <= 0.0F) continue;
      glm::vec4& texel = canvas.texels[static_cast<std::size_t>(y * canvas.width + x)];
      texel = texel * (1.0F - alpha) + glm::vec4(radiance, 1.0F) * alpha;
    }
  }
}

}  // namespace

const std::vector<std::string>& plant_kinds() {
  static const std::vector<std::string> kNames{"tree", "olive", "cypress", "shrub", "hedge", "lavender", "grass"};
  return kNames;
}

Painting paint_plant(const PlantSpec& plant, const glm::vec2& view, const Light& light, float texels_per_m,
                     std::uint32_t seed) {
  const glm::vec2 ahead = glm::normalize(view);
  const glm::vec2 right(ahead.y, -ahead.x);
  std::vector<Leaf> leaves = grow(plant, right, seed);
  const Density density(leaves, static_cast<float>(plant.height_m), static_cast<float>(plant.width_m));
  std::sort(leaves.begin(), leaves.end(), [&](const Leaf& a, const Leaf& b) {
    return glm::dot(glm::vec2(a.place), ahead) > glm::dot(glm::vec2(b.place), ahead);
  });
  Painting canvas;
  canvas.width = static_cast<int>(std::ceil(1.2 * plant.width_m * texels_per_m));
  canvas.height = static_cast<int>(std::ceil(1.1 * plant.height_m * texels_per_m));
  canvas.texels.assign(static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height),
                       glm::vec4(0.0F));
  const glm::vec3 up(0.0F, 0.0F, 1.0F);
  for (const Leaf& leaf : leaves) {
    const glm::vec3 towards_eye(-ahead, 0.0F);
    const glm::vec3 n = glm::dot(leaf.normal, towards_eye) < 0.0F ? -leaf.normal : leaf.normal;
    const float cosine = glm::dot(n, light.sun_direction());
    const float sunlit = density.open(leaf.place, light.sun_direction());
    const float skylit = 0.65F * density.open(leaf.place, up) + 0.35F * density.open(leaf.place, towards_eye);
    glm::vec3 radiance =
        light.sun_illuminance() * sunlit * (cosine > 0.0F ? leaf.albedo * cosine : leaf.through * -cosine);
    radiance += light.sky_illuminance(glm::normalize(n + 0.5F * up)) * skylit * (leaf.albedo + 0.5F * leaf.through);
    const glm::vec2 centre(
        0.5F * static_cast<float>(canvas.width) + glm::dot(glm::vec2(leaf.place), right) * texels_per_m,
        static_cast<float>(canvas.height) - leaf.place.z * texels_per_m);
    const glm::vec2 along(glm::dot(glm::vec2(leaf.along), right) * texels_per_m, -leaf.along.z * texels_per_m);
    const float facing = 0.35F + 0.65F * std::abs(glm::dot(leaf.normal, towards_eye));
    splat(canvas, centre, along, leaf.half_width_m * facing * texels_per_m, radiance / std::numbers::pi_v<float>);
  }
  canvas.build_levels();
  return canvas;
}

void Painting::build_levels() {
  levels_.clear();
  const Painting* fine = this;
  std::vector<Painting> levels;
  while (fine->width > 2 && fine->height > 2) {
    Painting half;
    half.width = fine->width / 2;
    half.height = fine->height / 2;
    half.texels.resize(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
    for (int y = 0; y < half.height; ++y) {
      for (int x = 0; x < half.width; ++x) {
        const auto at = [&](int dx, int dy) {
          return fine->texels[static_cast<std::size_t>((2 * y + dy) * fine->width + 2 * x + dx)];
        };
        half.texels[static_cast<std::size_t>(y * half.width + x)] = 0.25F * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1));
      }
    }
    levels.push_back(std::move(half));
    fine = &levels.back();
  }
  levels_ = std::move(levels);
}

glm::vec4 Painting::bilinear(glm::vec2 uv) const {
  const glm::vec2 at = uv * glm::vec2(width, height) - 0.5F;
  const int x = floor_of(at.x);
  const int y = floor_of(at.y);
  const glm::vec2 f = at - glm::vec2(x, y);
  const auto texel = [&](int column, int row) {
    if (column < 0 || row < 0 || column >= width || row >= height) return glm::vec4(0.0F);
    return texels[static_cast<std::size_t>(row * width + column)];
  };
  return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), f.x), glm::mix(texel(x, y + 1), texel(x + 1, y + 1), f.x),
                  f.y);
}

glm::vec4 Painting::sample(glm::vec2 uv, float footprint_texels) const {
  const auto level = static_cast<std::size_t>(
      std::clamp(std::log2(std::max(footprint_texels, 1e-3F)) + 0.5F, 0.0F, static_cast<float>(levels_.size())));
  return level == 0 ? bilinear(uv) : levels_[level - 1].bilinear(uv);
}

}  // namespace app::synth
