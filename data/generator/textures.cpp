#include "data/generator/textures.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "data/generator/noise.h"
#include "data/generator/timber.h"

namespace generator {
namespace {

constexpr float kTau = 6.2831853F;

std::uint8_t byte(float x) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0F, 1.0F) * 255.0F));
}

render::Image blank(int width, int height) {
  render::Image image;
  image.width = width;
  image.height = height;
  image.rgba.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  return image;
}

void set(render::Image& image, int x, int y, const glm::vec3& rgb, float alpha = 1.0F) {
  const auto at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 4;
  for (int c = 0; c < 3; ++c) image.rgba[at + static_cast<std::size_t>(c)] = byte(rgb[c]);
  image.rgba[at + 3] = byte(alpha);
}

// What a surface is at a point of its texture, 0 <= u, v < 1.
struct Surface {
  glm::vec3 srgb{0.5F};
  float height_mm = 0.0F;
  float roughness = 1.0F;
};
using SurfaceAt = std::function<Surface(float u, float v)>;

// Base colour, normal and roughness of a surface whose picture covers `size_mm`. Heights wrap around.
std::vector<render::Image> bake(int width, int height, const glm::vec2& size_mm, const SurfaceAt& surface) {
  std::vector<Surface> samples;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      samples.push_back(surface((static_cast<float>(x) + 0.5F) / static_cast<float>(width),
                                (static_cast<float>(y) + 0.5F) / static_cast<float>(height)));
    }
  }
  const auto at = [&](int x, int y) -> const Surface& {
    const int wx = (x + width) % width;
    const int wy = (y + height) % height;
    return samples[static_cast<std::size_t>(wy) * static_cast<std::size_t>(width) + static_cast<std::size_t>(wx)];
  };
  const glm::vec2 pixel_mm = size_mm / glm::vec2(width, height);
  render::Image color = blank(width, height);
  render::Image normal = blank(width, height);
  render::Image rough = blank(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float dx = (at(x + 1, y).height_mm - at(x - 1, y).height_mm) / (2.0F * pixel_mm.x);
      const float dy = (at(x, y - 1).height_mm - at(x, y + 1).height_mm) / (2.0F * pixel_mm.y);  // up in the picture
      set(color, x, y, at(x, y).srgb);
      set(normal, x, y, 0.5F + 0.5F * glm::normalize(glm::vec3(-dx, -dy, 1.0F)));
      set(rough, x, y, {1.0F, at(x, y).roughness, 0.0F});
    }
  }
  return {color, normal, rough};
}

// ---- wood ----------------------------------------------------------------------------------------------------------

// Late wood is dark and narrow at the outer edge of each year's ring.
float late_wood(float rings) {
  const float phase = rings - std::floor(rings);
  return std::pow(phase, 3.0F) * (1.0F - glm::smoothstep(0.93F, 1.0F, phase));
}

Surface grain(float late, float fibre, float tone, const glm::vec3& tint) {
  const glm::vec3 light(0.815F, 0.665F, 0.500F);
  const glm::vec3 dark(0.575F, 0.405F, 0.270F);
  Surface s;
  s.srgb = glm::mix(light, dark, std::clamp(0.16F + 0.62F * late - 0.14F * fibre, 0.0F, 1.0F)) * tone * tint;
  s.height_mm = 0.16F * late + 0.10F * fibre;
  s.roughness = 0.60F - 0.10F * late - 0.06F * fibre;
  return s;
}

// A knot: rings bend around it, and it is darker inside.
struct Knot {
  glm::vec2 at_m;
  float radius_m;
};

Surface long_grain(int band, float across, float along) {
  const auto seed = static_cast<std::uint32_t>(band * 101 + 7);
  const glm::vec2 p((across - 0.5F) * WoodSheet::kBandWidth, along * WoodSheet::kLength);
  const float wander = noise({0.5F, along * 3.0F}, {1, 3}, seed) * 0.010F +
                       fractal({across * 3.0F, along * 10.0F}, {64, 10}, 2, seed + 5) * 0.0035F;
  // The plank cuts the log at a depth that varies along it: cathedral arches where it is least.
  const float depth = 0.014F + 0.010F * static_cast<float>(band % 4) +
                      0.012F * std::cos(kTau * (along + hash(band, 3, 1))) * (band % 2 == 0 ? 1.0F : 0.4F);
  const float pith = (hash(band, 1, 2) - 0.5F) * 0.09F;
  float radius = std::hypot(p.x - pith + wander, depth);
  float knot_mask = 0.0F;
  if (band % 3 == 1) {
    const Knot knot{{(hash(band, 5, 4) - 0.5F) * 0.07F, hash(band, 6, 4) * WoodSheet::kLength}, 0.009F};
    glm::vec2 d = p - knot.at_m;
    d.y -= std::round(d.y / WoodSheet::kLength) * WoodSheet::kLength;
    const float r = glm::length(d * glm::vec2(1.0F, 0.62F));
    radius += 0.011F * std::exp(-r * r / (0.026F * 0.026F));
    knot_mask = 1.0F - glm::smoothstep(knot.radius_m * 0.75F, knot.radius_m, r);
    if (knot_mask > 0.0F) radius = glm::mix(radius, r * 2.2F, knot_mask);
  }
  const float late = late_wood(radius / 0.0052F + 0.25F * noise({across * 5.0F, along * 24.0F}, {64, 24}, seed + 9));
  const float fibre = fractal({across * 46.0F, along * 14.0F}, {4096, 14}, 3, seed + 13);
  const float blotch = noise({across * 2.0F, along * 5.0F}, {64, 5}, seed + 17);
  const float tones[7] = {1.0F, 0.93F, 1.05F, 0.87F, 0.98F, 1.03F, 0.91F};
  const glm::vec3 tints[7] = {{1, 1, 1},     {1.02F, 0.98F, 0.94F}, {0.99F, 1.0F, 1.0F},  {1.02F, 0.97F, 0.92F},
                              {1, 1, 1.04F}, {1.01F, 0.99F, 0.97F}, {0.97F, 0.99F, 1.03F}};
  Surface s = grain(late, fibre, tones[band] * (1.0F + 0.05F * blotch), tints[band]);
  s.srgb = glm::mix(s.srgb, glm::vec3(0.36F, 0.22F, 0.13F), 0.75F * knot_mask);
  return s;
}

Surface end_grain(float across, float along) {
  const float tile = std::floor(along * 4.0F);
  const glm::vec2 p(across - 0.5F, along * 4.0F - tile - 0.5F);
  const auto t = static_cast<int>(tile);
  const glm::vec2 pith(hash(t, 1, 9) * 1.4F - 0.7F, 0.45F + 0.4F * hash(t, 2, 9));
  const glm::vec2 d = p - pith;
  const float wobble = 0.02F * noise(p * 5.0F + 9.0F, {64, 64}, 31);
  const float late = late_wood((glm::length(d) + wobble) * WoodSheet::kBandWidth / 0.0058F);
  const float angle = std::atan2(d.y, d.x) * 9.0F;
  const float check = glm::smoothstep(0.80F, 0.97F, noise({angle + 40.0F, tile}, {256, 64}, 41));
  const float pores = fractal(p * 60.0F + 200.0F, {4096, 4096}, 2, 51);
  Surface s = grain(late, pores, 0.80F, {1.0F, 0.97F, 0.93F});
  s.srgb *= 1.0F - 0.45F * check;
  s.height_mm -= 0.4F * check;
  s.roughness = 0.8F;
  return s;
}

// ---- leaves --------------------------------------------------------------------------------------------------------

struct Leaf {
  glm::vec2 base;
  float angle;  // from straight up, clockwise
  float length;
  float width;
  glm::vec3 srgb;
};

// Paints one pointed oval leaf with a pale midrib and faint side veins.
void paint(render::Image& image, const Leaf& leaf, std::uint32_t seed) {
  const glm::vec2 up(std::sin(leaf.angle), -std::cos(leaf.angle));
  const glm::vec2 right(-up.y, up.x);
  const auto reach = static_cast<int>(leaf.length + 2.0F);
  const glm::ivec2 centre(leaf.base);
  for (int y = std::max(0, centre.y - reach); y < std::min(image.height, centre.y + reach); ++y) {
    for (int x = std::max(0, centre.x - reach); x < std::min(image.width, centre.x + reach); ++x) {
      const glm::vec2 d = glm::vec2(x, y) + 0.5F - leaf.base;
      const float t = glm::dot(d, up) / leaf.length;
      const float s = glm::dot(d, right) - 0.03F * leaf.length * std::sin(t * 3.1F);
      if (t < 0.0F || t > 1.0F) continue;
      const float half = 0.5F * leaf.width * std::pow(std::sin(3.14159F * std::pow(t, 0.80F)), 0.85F) + 0.6F;
      const float edge = half - std::abs(s);
      if (edge < -0.5F) continue;
      const float rib = std::exp(-s * s / 2.2F);
      const float vein = 0.5F + 0.5F * std::sin((t * 11.0F - std::abs(s) / leaf.width * 3.2F) * kTau);
      const float mottle = noise(glm::vec2(x, y) * 0.09F, {64, 64}, seed);
      glm::vec3 rgb = leaf.srgb * (0.93F + 0.06F * vein + 0.07F * mottle) * (s > 0.0F ? 1.05F : 0.95F);
      rgb = glm::mix(rgb, glm::vec3(0.62F, 0.70F, 0.34F), 0.55F * rib);
      const float shade = glm::smoothstep(0.0F, 3.0F, edge);  // a thin darker rim parts leaves that overlap
      set(image, x, y, rgb * (0.78F + 0.22F * shade), edge > 0.0F ? 1.0F : 0.0F);
    }
  }
}

void paint_sprig(render::Image& image, const glm::vec2& corner, float size, std::uint32_t seed) {
  const auto random = [&](int i, int k) { return hash(i, k, seed); };
  const glm::vec2 foot = corner + glm::vec2(0.5F * size, 0.985F * size);
  for (int i = 0; i < static_cast<int>(0.62F * size); ++i) {  // the twig
    for (int k = -1; k <= 1; ++k) {
      set(image, static_cast<int>(foot.x) + k, static_cast<int>(foot.y) - i, {0.34F, 0.36F, 0.16F});
    }
  }
  constexpr int kLeaves = 7;
  for (int i = 0; i < kLeaves; ++i) {
    const float t = static_cast<float>(i) / (kLeaves - 1);
    const float side = i % 2 == 0 ? 1.0F : -1.0F;
    const float angle = side * glm::mix(1.35F, 0.10F, t * t) + 0.35F * (random(i, 0) - 0.5F);
    const float young = random(i, 1) * 0.5F + 0.5F * t;
    const glm::vec3 color = glm::mix(glm::vec3(0.235F, 0.41F, 0.135F), glm::vec3(0.50F, 0.635F, 0.215F), young);
    const float length = size * glm::mix(0.40F, 0.34F, t) * (0.84F + 0.22F * random(i, 2));
    paint(image, {foot - glm::vec2(0.0F, size * (0.07F + 0.56F * t)), angle, length, length * 0.40F, color},
          seed + static_cast<std::uint32_t>(i));
  }
}

// Transparent pixels take the colour of leaves near by, so that no dark fringe shows when the texture is shrunk.
void bleed_colors(render::Image& image) {
  const auto at = [&](int x, int y) {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 4;
  };
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.rgba[at(x, y) + 3] != 0) continue;
      const float m = 0.9F + 0.1F * noise(glm::vec2(x, y) * 0.03F, {64, 64}, 3);
      set(image, x, y, glm::vec3(0.33F, 0.49F, 0.16F) * m, 0.0F);
    }
  }
}

}  // namespace

std::vector<render::Image> wood_textures() {
  const glm::vec2 size_mm(WoodSheet::kBands * WoodSheet::kBandWidth * 1000.0F, WoodSheet::kLength * 1000.0F);
  return bake(1024, 512, size_mm, [](float u, float v) {
    const float scaled = u * WoodSheet::kBands;
    const int band = std::min(static_cast<int>(scaled), WoodSheet::kBands - 1);
    const float across = scaled - static_cast<float>(band);
    return band == WoodSheet::kBands - 1 ? end_grain(across, v) : long_grain(band, across, v);
  });
}

std::vector<render::Image> terracotta_textures() {
  std::vector<render::Image> images = bake(256, 256, {500, 500}, [](float u, float v) {
    const float cloud = fractal({u * 4, v * 4}, {4, 4}, 4, 3);
    const float turning = noise({u * 2, v * 70}, {2, 70}, 5);  // lines left by the potter's hand
    const float salt = glm::smoothstep(0.20F, 0.75F, fractal({u * 5, v * 5}, {5, 5}, 4, 17));
    const float pits = fractal({u * 48, v * 48}, {48, 48}, 2, 7);
    Surface s;
    s.srgb = glm::vec3(0.725F, 0.410F, 0.275F) * (1.0F + 0.10F * cloud + 0.035F * turning + 0.05F * pits);
    s.srgb = glm::mix(s.srgb, glm::vec3(0.80F, 0.66F, 0.56F), 0.45F * salt);
    s.height_mm = 0.5F * turning + 0.25F * pits + 0.3F * cloud;
    return s;
  });
  images.resize(2);
  return images;
}

std::vector<render::Image> soil_textures() {
  std::vector<render::Image> images = bake(128, 128, {300, 300}, [](float u, float v) {
    const float clods = fractal({u * 12, v * 12}, {12, 12}, 4, 23);
    const float stone = glm::smoothstep(0.55F, 0.65F, noise({u * 18, v * 18}, {18, 18}, 29));
    Surface s;
    s.srgb = glm::mix(glm::vec3(0.235F, 0.175F, 0.130F) * (1.0F + 0.5F * clods), glm::vec3(0.50F, 0.46F, 0.41F),
                      0.6F * stone);
    s.height_mm = 5.0F * clods + 2.0F * stone;
    return s;
  });
  images.resize(2);
  return images;
}

std::vector<render::Image> granite_textures() {
  std::vector<render::Image> images = bake(256, 256, {400, 400}, [](float u, float v) {
    const float large = fractal({u * 6, v * 6}, {6, 6}, 3, 61);
    const float grains = noise({u * 70, v * 70}, {70, 70}, 67);
    const float mica = glm::smoothstep(0.55F, 0.75F, noise({u * 90, v * 90}, {90, 90}, 71));
    Surface s;
    s.srgb = glm::vec3(0.56F, 0.55F, 0.53F) * (1.0F + 0.10F * large + 0.16F * grains);
    s.srgb = glm::mix(s.srgb, glm::vec3(0.22F, 0.22F, 0.23F), 0.7F * mica);
    s.height_mm = 0.8F * large + 0.35F * grains;
    return s;
  });
  images.resize(2);
  return images;
}

std::vector<render::Image> bark_textures() {
  std::vector<render::Image> images = bake(128, 256, {250, 500}, [](float u, float v) {
    const float furrow = fractal({u * 10 + 0.6F * noise({u * 4, v * 5}, {4, 5}, 83), v * 4}, {10, 4}, 4, 79);
    const float lichen = glm::smoothstep(0.35F, 0.7F, fractal({u * 4, v * 8}, {4, 8}, 3, 89));
    Surface s;
    s.srgb = glm::vec3(0.42F, 0.36F, 0.29F) * (1.0F + 0.45F * furrow);
    s.srgb = glm::mix(s.srgb, glm::vec3(0.52F, 0.53F, 0.43F), 0.5F * lichen);
    s.height_mm = 3.0F * furrow;
    return s;
  });
  images.resize(2);
  return images;
}

render::Image leaf_texture() {
  constexpr int kSize = 512;
  render::Image image = blank(kSize, kSize);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t column = i % 2;
    const std::uint32_t row = i / 2;
    const glm::vec2 corner(static_cast<float>(column) * kSize / 2, static_cast<float>(row) * kSize / 2);
    paint_sprig(image, corner, kSize / 2.0F, 200 + 31 * i);
  }
  bleed_colors(image);
  return image;
}

}  // namespace generator
