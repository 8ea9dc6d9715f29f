#include "render/images/finite_pixels.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace render {
namespace {

constexpr float kLargestHalf = 65504.0F;
constexpr float kLargestValid = 1e30F;  // sums over a picture and products with colour matrices stay finite

bool is_valid(float value) {
  return value >= -kLargestValid && value <= kLargestValid;  // NaN is not
}

bool is_valid(const glm::vec3& rgb) {
  return is_valid(rgb.x) && is_valid(rgb.y) && is_valid(rgb.z);
}

std::optional<float> largest_valid(const LinearImage& image) {
  std::optional<float> largest;
  for (const glm::vec3& rgb : image.rgb) {
    for (int c = 0; c < 3; ++c) {
      if (is_valid(rgb[c])) largest = std::max(largest.value_or(rgb[c]), rgb[c]);
    }
  }
  return largest;
}

// Mean of the valid values of channel `c` around pixel (x, y).
float mean_around(const LinearImage& image, int x, int y, int c) {
  double sum = 0.0;
  int count = 0;
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, image.height - 1); ++row) {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, image.width - 1); ++column) {
      const float value = image.rgb[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                                    static_cast<std::size_t>(column)][c];
      if (!is_valid(value)) continue;
      sum += static_cast<double>(value);
      ++count;
    }
  }
  return count > 0 ? static_cast<float>(sum / count) : 0.0F;
}

glm::vec3 filled(const LinearImage& image, std::size_t index) {
  const auto width = static_cast<std::size_t>(image.width);
  glm::vec3 rgb = image.rgb[index];
  for (int c = 0; c < 3; ++c) {
    if (is_valid(rgb[c])) continue;
    rgb[c] = mean_around(image, static_cast<int>(index % width), static_cast<int>(index / width), c);
  }
  return rgb;
}

}  // namespace

std::size_t replace_invalid_values(LinearImage& image, const std::string& file) {
  std::vector<std::size_t> invalid;
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    if (!is_valid(image.rgb[i])) invalid.push_back(i);
  }
  if (invalid.empty()) return 0;
  const std::optional<float> largest = largest_valid(image);
  if (!largest) throw std::runtime_error("all its values are infinite or not a number");
  const float peak = std::max(*largest, kLargestHalf);
  for (const std::size_t i : invalid) {
    for (int c = 0; c < 3; ++c) {
      if (image.rgb[i][c] > kLargestValid) image.rgb[i][c] = peak;
    }
  }
  // From what was valid or too large alone, not from values filled in before.
  std::vector<std::pair<std::size_t, glm::vec3>> fills;
  for (const std::size_t i : invalid) {
    if (!is_valid(image.rgb[i])) fills.emplace_back(i, filled(image, i));
  }
  for (const auto& [i, rgb] : fills) image.rgb[i] = rgb;
  spdlog::warn("{}: {} of {} pixels {} infinite, too large or not a number; replaced (infinity by {})", file,
               invalid.size(), image.rgb.size(), invalid.size() == 1 ? "is" : "are", peak);
  return invalid.size();
}

}  // namespace render
