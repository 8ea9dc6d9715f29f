#include "app/synth/film.h"

#include <algorithm>
#include <cmath>

#include "app/synth/noise.h"
#include "app/synth/parallel.h"
#include "render/base/luminance.h"

namespace app::synth {

namespace {

// The shaders' own function, compiled by GLM.
namespace glsl {
using glm::clamp;
using glm::max;
using glm::min;
using glm::vec3;
[[maybe_unused]] vec3 shoulder_inverse(vec3 shown);  // the composite's business
#include "shaders/lib/shoulder.glsl"
}  // namespace glsl

constexpr float kGrey = 0.18F;
constexpr float kShotShare = 0.75F;  // of the variance at grey; the rest is read noise
constexpr int kNormals = 4096;

// Standard normal quantile by bisection of erfc: only for the table.
double normal_quantile(double p) {
  double low = -6.0;
  double high = 6.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < p ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

struct YCbCr {
  float y, cb, cr;
};

// ITU-R BT.709-6, item 3: from encoded R'G'B'.
YCbCr bt709_matrix(const glm::vec3& rgb) {
  const float y = render::rec709_luminance(rgb.r, rgb.g, rgb.b);
  return {y, (rgb.b - y) / 1.8556F, (rgb.r - y) / 1.5748F};
}

// A sample in its plane, limited range (ITU-R BT.709-6, item 4.6).
void store(const ar::OutputFrame& out, int plane, int x, int y, float code8) {
  std::uint8_t* const row = out.plane[static_cast<std::size_t>(plane)] +
                            static_cast<std::ptrdiff_t>(y) * out.stride_bytes[static_cast<std::size_t>(plane)];
  if (out.format.bit_depth == 8) {
    row[x] = static_cast<std::uint8_t>(std::lround(std::clamp(code8, 0.0F, 255.0F)));
    return;
  }
  const auto code10 = static_cast<unsigned>(std::lround(std::clamp(4.0F * code8, 0.0F, 1023.0F)));
  row[2 * x] = static_cast<std::uint8_t>(code10 & 255U);
  row[2 * x + 1] = static_cast<std::uint8_t>(code10 >> 8U);
}

// bt709_encode by table: three powers a pixel would be felt.
class EncodeTable {
 public:
  EncodeTable() {
    for (int i = 0; i <= kSteps + 1; ++i) {
      const float root = static_cast<float>(i) / kSteps;
      table_[static_cast<std::size_t>(i)] = bt709_encode(root * root);
    }
  }
  float operator()(float linear) const {
    const float at = std::sqrt(std::clamp(linear, 0.0F, 1.0F)) * kSteps;
    const auto i = static_cast<std::size_t>(at);
    return table_[i] + (table_[i + 1] - table_[i]) * (at - static_cast<float>(i));
  }

 private:
  static constexpr int kSteps = 4096;
  std::array<float, kSteps + 2> table_{};
};

}  // namespace

glm::vec3 roll_off(const glm::vec3& linear) {
  return glm::min(glsl::shoulder(linear), glm::vec3(1.0F));
}

float bt709_encode(float linear) {
  const float x = std::clamp(linear, 0.0F, 1.0F);
  return x < 0.018F ? 4.5F * x : 1.099F * std::pow(x, 0.45F) - 0.099F;
}

Film::Film(const Spec& spec) : seed_(mix_bits(spec.seed + 0x51ed27U)) {
  const double slope = 1.099 * 0.45 * std::pow(kGrey, -0.55);  // of the transfer function at grey
  const auto sigma = static_cast<float>(spec.noise_codes / (219.0 * slope));
  shot_sigma_ = sigma * std::sqrt(kShotShare / kGrey);
  read_sigma_ = sigma * std::sqrt(1.0F - kShotShare);
  for (int i = 0; i < kNormals; ++i) normal_.push_back(static_cast<float>(normal_quantile((i + 0.5) / kNormals)));
}

void Film::develop(const LinearFrame& light, int frame, const ar::OutputFrame& out) const {
  static const EncodeTable encode;
  const int width = light.width;
  const std::uint32_t frame_seed = mix_bits(seed_ + static_cast<std::uint32_t>(frame) * 2654435761U);
  const auto encoded = [&](int x, int y) {
    const glm::vec3& linear =
        light.rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
    std::uint32_t bits = hash_cell(x, y, frame_seed);
    glm::vec3 rgb;
    const glm::vec3 clean = roll_off(linear);
    for (int c = 0; c < 3; ++c) {
      const float sigma = std::sqrt(read_sigma_ * read_sigma_ + shot_sigma_ * shot_sigma_ * clean[c]);
      rgb[c] = encode(clean[c] + sigma * noise(bits));
      bits = mix_bits(bits + 0x9e3779b9U);
    }
    return bt709_matrix(rgb);
  };
  parallel_for((light.height + 1) / 2, [&](int pair) {
    std::vector<float> cb(static_cast<std::size_t>(width), 0.0F);
    std::vector<float> cr(static_cast<std::size_t>(width), 0.0F);
    const int rows = std::min(2, light.height - 2 * pair);
    for (int dy = 0; dy < rows; ++dy) {
      for (int x = 0; x < width; ++x) {
        const YCbCr code = encoded(x, 2 * pair + dy);
        store(out, 0, x, 2 * pair + dy, 16.0F + 219.0F * code.y);
        cb[static_cast<std::size_t>(x)] += code.cb / static_cast<float>(rows);
        cr[static_cast<std::size_t>(x)] += code.cr / static_cast<float>(rows);
      }
    }
    const auto at = [&](const std::vector<float>& row, int x) {
      return row[static_cast<std::size_t>(std::clamp(x, 0, width - 1))];
    };
    for (int x = 0; x < (width + 1) / 2; ++x) {  // 1 2 1 about the even column: chroma is sited left
      const auto filtered = [&](const std::vector<float>& row) {
        return 0.25F * at(row, 2 * x - 1) + 0.5F * at(row, 2 * x) + 0.25F * at(row, 2 * x + 1);
      };
      store(out, 1, x, pair, 128.0F + 224.0F * filtered(cb));
      store(out, 2, x, pair, 128.0F + 224.0F * filtered(cr));
    }
  });
}

}  // namespace app::synth
