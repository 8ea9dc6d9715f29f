#include "app/synth/backdrop.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/synth/noise.h"
#include "app/synth/parallel.h"
#include "app/synth/plants.h"

namespace app::synth {

namespace {

glm::vec3 direction_of(float azimuth, float elevation) {
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation)};
}

// Noise on the circle of azimuths: sampled on a ring in the plane, so that north has no seam.
float ring_noise(float azimuth, float features, int octaves, std::uint32_t seed) {
  const float radius = features / (2.0F * std::numbers::pi_v<float>);
  return fractal_noise(glm::vec2(std::cos(azimuth), std::sin(azimuth)) * radius + 200.0F, octaves, seed);
}

}  // namespace

Backdrop::Backdrop(const Spec& spec, const Light& light, const Gaze& gaze) {
  find_seen_columns(gaze);
  bake_sky(spec, light);
  if (spec.horizon) {
    bake_hills(spec, light);
    bake_meadow(spec, light);
    bake_trees(spec, light);
  }
}

void Backdrop::find_seen_columns(const Gaze& gaze) {
  constexpr int kStrip = 64;
  seen_.assign(kWidth, 0);
  for (int x = 0; x < kWidth; x += kStrip) {
    const float azimuth = 2.0F * std::numbers::pi_v<float> * (static_cast<float>(x) + 0.5F * kStrip) / kWidth;
    bool seen = false;
    for (float elevation = 0.0F; elevation < 0.75F; elevation += 0.1F)  // -2 to 38 degrees
      seen = seen || gaze.sees_far(direction_of(azimuth, elevation), 0.1F);
    std::fill_n(seen_.begin() + x, kStrip, static_cast<std::uint8_t>(seen));
  }
}

glm::vec3 Backdrop::sky(float azimuth, float elevation) const {
  const float x = azimuth / (2.0F * std::numbers::pi_v<float>)*kSkyWidth;
  const float y = glm::clamp(elevation / (0.5F * std::numbers::pi_v<float>), 0.0F, 1.0F) * (kSkyHeight - 1);
  const float xf = std::floor(x);
  const int y0 = std::min(static_cast<int>(y), kSkyHeight - 2);
  const auto at = [&](int dx, int dy) {
    const int column = (static_cast<int>(xf) + dx + 8 * kSkyWidth) % kSkyWidth;
    return sky_[static_cast<std::size_t>((y0 + dy) * kSkyWidth + column)];
  };
  const float fx = x - xf;
  const float fy = y - static_cast<float>(y0);
  return glm::mix(glm::mix(at(0, 0), at(1, 0), fx), glm::mix(at(0, 1), at(1, 1), fx), fy);
}

void Backdrop::bake_sky(const Spec& spec, const Light& light) {
  sky_.resize(static_cast<std::size_t>(kSkyWidth) * kSkyHeight);
  parallel_for(kSkyHeight, [&](int y) {
    const float elevation =
        std::max(0.5F * std::numbers::pi_v<float> * static_cast<float>(y) / (kSkyHeight - 1), 0.008F);
    for (int x = 0; x < kSkyWidth; ++x) {
      sky_[static_cast<std::size_t>(y * kSkyWidth + x)] = light.sky_luminance(
          direction_of(2.0F * std::numbers::pi_v<float> * static_cast<float>(x) / kSkyWidth, elevation));
    }
  });
  if (!spec.horizon && spec.clouds <= 0.0) return;  // the coarse sky says it all
  panorama_.resize(static_cast<std::size_t>(kWidth) * kHeight);
  const auto cover = static_cast<float>(spec.clouds);
  const glm::vec3 sun = light.sun_direction();
  parallel_for(kHeight, [&](int y) {
    const float elevation = static_cast<float>(y - kBelow) * 2.0F * std::numbers::pi_v<float> / kWidth;
    for (int x = 0; x < kWidth; ++x) {
      if (seen_[static_cast<std::size_t>(x)] == 0) continue;
      const float azimuth = 2.0F * std::numbers::pi_v<float> * (static_cast<float>(x) + 0.5F) / kWidth;
      glm::vec3 radiance = sky(azimuth, std::max(elevation, 0.0F));
      if (cover > 0.0F && elevation > 0.01F) {  // cirrus: a thin sheet seen along its slant
        const glm::vec3 d = direction_of(azimuth, elevation);
        const glm::vec2 sheet = glm::vec2(d) / (d.z + 0.10F);
        const glm::vec2 combed(0.8F * sheet.x + 0.6F * sheet.y, 3.1F * (0.8F * sheet.y - 0.6F * sheet.x));
        const float veil = fractal_noise(combed * 1.3F + 31.0F, 6, spec.seed + 501U, 0.58F);
        const float field = fractal_noise(sheet * 0.6F + 7.0F, 3, spec.seed + 502U);
        const float depth = cover * smooth_ramp(0.62F - 0.3F * cover, 0.95F, 0.55F * veil + 0.55F * field);
        const float forward = std::max(glm::dot(d, sun), 0.0F);
        const glm::vec3 lit = light.sun_illuminance() * (0.035F + 0.10F * std::pow(forward, 6.0F)) +
                              light.sky_illuminance({0.0F, 0.0F, 1.0F}) * 0.16F;
        radiance = glm::mix(radiance, lit, 0.8F * depth * smooth_ramp(0.01F, 0.12F, elevation));
      }
      texel(x, y) = radiance;
    }
  });
}

void Backdrop::bake_hills(const Spec& spec, const Light& light) {
  struct Ridge {
    float distance_m, mean_deg, swing_deg, features;
    int octaves;
  };
  constexpr std::array<Ridge, 3> kRidges{
      {{9000.0F, 2.6F, 3.2F, 17.0F, 7}, {4200.0F, 1.3F, 2.4F, 31.0F, 7}, {1700.0F, 0.4F, 1.7F, 53.0F, 6}}};
  const float visibility_m = 14000.0F;
  const glm::vec3 sun_flat = light.sun_direction();
  std::uint32_t seed = spec.seed + 600U;
  for (const Ridge& ridge : kRidges) {
    ++seed;
    const float clear = std::exp(-2.2F * ridge.distance_m / visibility_m);
    parallel_for(kWidth, [&](int x) {
      if (seen_[static_cast<std::size_t>(x)] == 0) return;
      const float azimuth = 2.0F * std::numbers::pi_v<float> * (static_cast<float>(x) + 0.5F) / kWidth;
      const float rise = ring_noise(azimuth, ridge.features, ridge.octaves, seed);
      const float bush = ring_noise(azimuth, 1400.0F, 3, seed + 50U) - 0.5F;
      const float top =
          (ridge.mean_deg + ridge.swing_deg * (2.0F * rise - 1.0F) + 60.0F / ridge.distance_m * 9.0F * bush) *
          std::numbers::pi_v<float> / 180.0F;
      const float top_row = top * kWidth / (2.0F * std::numbers::pi_v<float>)+kBelow;
      const glm::vec3 air = sky(azimuth, 0.02F) * 0.92F;
      for (int y = 0; y < std::min(kHeight, static_cast<int>(top_row) + 1); ++y) {
        const float depth = top_row - static_cast<float>(y);
        const float cover = glm::clamp(depth, 0.0F, 1.0F);
        const glm::vec2 at(azimuth * ridge.features * 4.0F, static_cast<float>(y) * 0.06F);
        const float woods = fractal_noise(at * glm::vec2(3.0F, 1.6F), 5, seed + 90U, 0.6F);
        const glm::vec3 albedo = glm::mix(glm::vec3(0.035F, 0.052F, 0.026F), glm::vec3(0.13F, 0.12F, 0.065F), woods);
        const glm::vec3 facing = direction_of(azimuth + std::numbers::pi_v<float> + 1.6F * (woods - 0.5F), 0.5F);
        const glm::vec3 lit =
            albedo / std::numbers::pi_v<float> *
            (light.sun_illuminance() * std::max(glm::dot(facing, sun_flat), 0.03F) + light.sky_illuminance(facing));
        texel(x, y) = glm::mix(texel(x, y), glm::mix(air, lit, clear), cover);
      }
    });
  }
}

// Grass from the end of the near ground to the trees' feet.
void Backdrop::bake_meadow(const Spec& spec, const Light& light) {
  const glm::vec3 up(0.0F, 0.0F, 1.0F);
  const glm::vec3 lux = light.sun_illuminance() * std::max(light.sun_direction().z, 0.0F) + light.sky_illuminance(up);
  parallel_for(kBelow, [&](int y) {
    const float down = (static_cast<float>(kBelow - y) - 0.5F) * 2.0F * std::numbers::pi_v<float> / kWidth;
    const float distance_m = std::min(1.6F / down, 400.0F);
    for (int x = 0; x < kWidth; ++x) {
      if (seen_[static_cast<std::size_t>(x)] == 0) continue;
      const float azimuth = 2.0F * std::numbers::pi_v<float> * (static_cast<float>(x) + 0.5F) / kWidth;
      const glm::vec2 at = glm::vec2(std::sin(azimuth), std::cos(azimuth)) * distance_m;
      const float dry = fractal_noise(at * 0.05F, 4, spec.seed + 650U);
      const float tuft = fractal_noise(at * 0.7F, 3, spec.seed + 651U);
      const glm::vec3 albedo =
          glm::mix(glm::vec3(0.050F, 0.080F, 0.022F), glm::vec3(0.15F, 0.14F, 0.065F), dry) * (0.55F + 0.9F * tuft);
      const float haze = 1.0F - std::exp(-distance_m / 900.0F);
      texel(x, y) = glm::mix(albedo * lux / std::numbers::pi_v<float>, 0.85F * sky(azimuth, 0.03F), haze);
    }
  });
}

namespace {

constexpr float kTreeTexelsPerMetre = 22.0F;
constexpr int kTreeKinds = 4;
constexpr int kTreeSectors = 5;

// The trees of one direction as they look from the middle, by kind; the last is a cypress.
std::array<Painting, kTreeKinds> paint_tree_kinds(float azimuth, const Light& light, std::uint32_t seed) {
  std::array<Painting, kTreeKinds> kinds;
  parallel_for(kTreeKinds, [&](int k) {
    const PlantSpec plant{.kind = k == 3 ? "cypress" : "tree",
                          .position = {},
                          .height_m = k == 3 ? 12.0 : 8.0 + k,
                          .width_m = k == 3 ? 2.6 : 8.5};
    kinds[static_cast<std::size_t>(k)] = paint_plant(plant, {std::sin(azimuth), std::cos(azimuth)}, light,
                                                     kTreeTexelsPerMetre, seed + static_cast<std::uint32_t>(k));
  });
  return kinds;
}

}  // namespace

struct Backdrop::TreeStand {
  float azimuth = 0.0F;
  float distance_m = 0.0F;
  int kind = 0;
  bool mirrored = false;
};

int Backdrop::column_at(float azimuth) {
  return static_cast<int>(azimuth / (2.0F * std::numbers::pi_v<float>)*kWidth);
}

// The trees about an azimuth that may be seen, farthest first.
std::vector<Backdrop::TreeStand> Backdrop::stands_about(float middle, std::uint32_t seed, Random& random) const {
  constexpr int kCount = 340;     // over all azimuths, where woods are
  constexpr int kHalfTree = 120;  // columns, of the widest and nearest
  std::vector<TreeStand> stands;
  for (int i = 0; i < kCount / kTreeSectors; ++i) {
    const float azimuth = middle + random.between(-0.5F, 0.5F) * 2.0F * std::numbers::pi_v<float> / kTreeSectors;
    const float wood = ring_noise(azimuth, 22.0F, 3, seed + 720U);
    if (wood < 0.40F) continue;
    stands.push_back({azimuth, random.between(62.0F, 170.0F),
                      random.next() < 0.16F ? 3 : static_cast<int>(random.next() * 3.0F), random.next() < 0.5F});
  }
  const auto in_sight = [&](int column) { return seen_[static_cast<std::size_t>((column + kWidth) % kWidth)] != 0; };
  std::erase_if(stands, [&](const TreeStand& stand) {
    const int column = column_at(stand.azimuth);
    return !in_sight(column - kHalfTree) && !in_sight(column) && !in_sight(column + kHalfTree);
  });
  std::sort(stands.begin(), stands.end(),
            [](const TreeStand& a, const TreeStand& b) { return a.distance_m > b.distance_m; });
  return stands;
}

void Backdrop::draw_tree(const TreeStand& stand, const Painting& tree, const glm::vec3& air) {
  // Texels of the painting in one of the panorama.
  const float scale = kTreeTexelsPerMetre * stand.distance_m * 2.0F * std::numbers::pi_v<float> / kWidth;
  const float haze = 1.0F - std::exp(-stand.distance_m / 900.0F);
  const float foot = static_cast<float>(kBelow) - 1.6F / stand.distance_m * kWidth / (2.0F * std::numbers::pi_v<float>);
  const int wide = static_cast<int>(static_cast<float>(tree.width) / scale);
  const int tall = static_cast<int>(static_cast<float>(tree.height) / scale);
  const int left = column_at(stand.azimuth) - wide / 2;
  for (int y = 0; y < tall; ++y) {
    const int row = static_cast<int>(foot) + y;
    if (row < 0 || row >= kHeight) continue;
    for (int x = 0; x < wide; ++x) {
      glm::vec2 uv((static_cast<float>(x) + 0.5F) / static_cast<float>(wide),
                   1.0F - (static_cast<float>(y) + 0.5F) / static_cast<float>(tall));
      if (stand.mirrored) uv.x = 1.0F - uv.x;
      const glm::vec4 leaf = tree.sample(uv, scale);
      glm::vec3& behind = texel((left + x + kWidth) % kWidth, row);
      behind = behind * (1.0F - leaf.a) + glm::mix(glm::vec3(leaf), air * leaf.a, haze);
    }
  }
}

void Backdrop::bake_trees(const Spec& spec, const Light& light) {
  Random random(spec.seed + 700U);
  for (int sector = 0; sector < kTreeSectors; ++sector) {  // light falls differently on trees in different directions
    const float middle = 2.0F * std::numbers::pi_v<float> * (static_cast<float>(sector) + 0.5F) / kTreeSectors;
    const std::vector<TreeStand> stands = stands_about(middle, spec.seed, random);
    if (stands.empty()) continue;
    const auto kinds = paint_tree_kinds(middle, light, spec.seed + 710U);
    const glm::vec3 air = sky(middle, 0.03F) * 0.85F;
    for (const TreeStand& stand : stands) draw_tree(stand, kinds[static_cast<std::size_t>(stand.kind)], air);
  }
}

glm::vec3 Backdrop::luminance(const glm::vec3& direction) const {
  const float azimuth = std::atan2(direction.x, direction.y);
  const float elevation = std::asin(glm::clamp(direction.z, -1.0F, 1.0F));
  const float y = elevation * kWidth / (2.0F * std::numbers::pi_v<float>)+kBelow;
  if (panorama_.empty() || y >= kHeight - 1) return sky(azimuth, elevation);
  const float x = azimuth / (2.0F * std::numbers::pi_v<float>)*kWidth - 0.5F + kWidth;
  const int column = floor_of(x);
  const float yc = std::max(y, 0.0F);
  const int x0 = column % kWidth;
  const int x1 = (x0 + 1) % kWidth;
  const int y0 = static_cast<int>(yc);
  const float fx = x - static_cast<float>(column);
  const float fy = yc - static_cast<float>(y0);
  const auto at = [&](int across, int row) { return panorama_[static_cast<std::size_t>(row * kWidth + across)]; };
  return glm::mix(glm::mix(at(x0, y0), at(x1, y0), fx), glm::mix(at(x0, y0 + 1), at(x1, y0 + 1), fx), fy);
}

}  // namespace app::synth
