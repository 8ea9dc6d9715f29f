#include "tests/golden/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

namespace golden {
namespace {

render::Image difference_picture(const render::Image& found, const render::Image& reference) {
  constexpr int kGain = 16;
  render::Image out = found;
  for (std::size_t i = 0; i < out.rgba.size(); ++i) {
    const int difference = kGain * (found.rgba[i] - reference.rgba[i]);
    out.rgba[i] = i % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(std::clamp(128 + difference, 0, 255));
  }
  return out;
}

}  // namespace

LinearDifference compare_linear(const render::LinearImage& found, const render::LinearImage& reference) {
  EXPECT_EQ(found.rgb.size(), reference.rgb.size());
  double error = 0.0;
  double power = 0.0;
  double sum = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < reference.rgb.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double r = reference.rgb[i][c];
      const double d = found.rgb[i][c] - r;
      error += d * d;
      power += r * r;
      sum += std::abs(r);
      largest = std::max(largest, std::abs(d));
    }
  }
  const double mean = sum / (3.0 * static_cast<double>(reference.rgb.size()));
  return {std::sqrt(error / power), largest / mean};
}

DisplayDifference compare_display(const render::Image& found, const render::Image& reference) {
  EXPECT_EQ(found.rgba.size(), reference.rgba.size());
  DisplayDifference out;
  double squares = 0.0;
  for (std::size_t i = 0; i < reference.rgba.size(); ++i) {
    const int d = std::abs(found.rgba[i] - reference.rgba[i]);
    out.max_steps = std::max(out.max_steps, d);
    out.mean_steps += d;
    squares += d * d;
  }
  const auto n = static_cast<double>(reference.rgba.size());
  out.mean_steps /= n;
  out.psnr_db =
      squares > 0.0 ? 10.0 * std::log10(255.0 * 255.0 * n / squares) : std::numeric_limits<double>::infinity();
  return out;
}

testing::AssertionResult same_display(const std::string& name, const render::Image& found,
                                      const render::Image& reference, int max_steps) {
  if (found.width != reference.width || found.height != reference.height) {
    return testing::AssertionFailure() << name << ": " << found.width << " x " << found.height << " pixels, expected "
                                       << reference.width << " x " << reference.height;
  }
  const DisplayDifference difference = compare_display(found, reference);
  if (difference.max_steps <= max_steps) return testing::AssertionSuccess();
  const std::filesystem::path folder = std::filesystem::path(SKYSHAFT_BINARY_DIR) / "golden-failures";
  std::filesystem::create_directories(folder);
  render::write_png(folder / (name + "-found.png"), found);
  render::write_png(folder / (name + "-reference.png"), reference);
  render::write_png(folder / (name + "-difference.png"), difference_picture(found, reference));
  return testing::AssertionFailure() << name << ": differs by up to " << difference.max_steps << " steps (at most "
                                     << max_steps << "), PSNR " << difference.psnr_db << " dB; see "
                                     << (folder / (name + "-difference.png")).string();
}

}  // namespace golden
