#include "render/compare/image_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "render/base/luminance.h"
#include "render/compare/filter.h"
#include "render/compare/flip.h"

namespace render {
namespace {

template <typename Picture>
void require_same_size(const Picture& a, const Picture& b) {
  if (a.width == b.width && a.height == b.height) return;
  throw std::invalid_argument("the pictures differ in size: " + std::to_string(a.width) + " x " +
                              std::to_string(a.height) + " and " + std::to_string(b.width) + " x " +
                              std::to_string(b.height));
}

Plane luma(const Image& image) {
  Plane plane{image.width, image.height, {}};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    plane.values.push_back(rec709_luminance<double>(image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]));
  }
  return plane;
}

Plane product(const Plane& a, const Plane& b) {
  Plane out{a.width, a.height, {}};
  for (std::size_t i = 0; i < a.values.size(); ++i) out.values.push_back(a.values[i] * b.values[i]);
  return out;
}

double mean_ssim(const Image& test, const Image& truth) {
  constexpr double kC1 = (0.01 * 255.0) * (0.01 * 255.0);
  constexpr double kC2 = (0.03 * 255.0) * (0.03 * 255.0);
  std::vector<double> window = kernel(5, [](double x) { return std::exp(-x * x / (2.0 * 1.5 * 1.5)); });
  normalize(window);
  const auto mean = [&](const Plane& plane) { return filtered(plane, window, window); };
  const Plane a = luma(test);
  const Plane b = luma(truth);
  const Plane mean_a = mean(a);
  const Plane mean_b = mean(b);
  const Plane square_a = mean(product(a, a));
  const Plane square_b = mean(product(b, b));
  const Plane both = mean(product(a, b));
  double sum = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double ma = mean_a.values[i];
    const double mb = mean_b.values[i];
    const double variances = square_a.values[i] - ma * ma + square_b.values[i] - mb * mb;
    const double covariance = both.values[i] - ma * mb;
    sum += (2.0 * ma * mb + kC1) * (2.0 * covariance + kC2) / ((ma * ma + mb * mb + kC1) * (variances + kC2));
  }
  return sum / static_cast<double>(a.values.size());
}

// The pixels within two of an edge.
std::vector<bool> near_edges(int width, int height, std::span<const float> distance_m) {
  std::vector<bool> near(distance_m.size(), false);
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  const auto apart = [&](std::size_t a, std::size_t b) {
    return std::max(distance_m[a], distance_m[b]) > 1.1F * std::min(distance_m[a], distance_m[b]);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool edge = (x + 1 < width && apart(index(x, y), index(x + 1, y))) ||
                        (y + 1 < height && apart(index(x, y), index(x, y + 1)));
      if (!edge) continue;
      for (int j = std::max(y - 2, 0); j <= std::min(y + 2, height - 1); ++j) {
        for (int i = std::max(x - 2, 0); i <= std::min(x + 2, width - 1); ++i) near[index(i, j)] = true;
      }
    }
  }
  return near;
}

int largest_difference(const Image& a, const Image& b, std::size_t pixel) {
  int largest = 0;
  for (std::size_t c = 0; c < 3; ++c)
    largest = std::max(largest, std::abs(a.rgba[4 * pixel + c] - b.rgba[4 * pixel + c]));
  return largest;
}

}  // namespace

LinearError linear_error(const LinearImage& test, const LinearImage& truth) {
  require_same_size(test, truth);
  double difference = 0.0;
  double square = 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.rgb.size(); ++i) {
    const glm::dvec3 t(truth.rgb[i]);
    const glm::dvec3 d = glm::dvec3(test.rgb[i]) - t;
    difference += glm::dot(d, d);
    square += glm::dot(t, t);
    sum += t.x + t.y + t.z;
  }
  LinearError error;
  if (difference == 0.0) return error;
  error.relative_rmse = std::sqrt(difference / square);
  const double floor = 0.01 * sum / (3.0 * static_cast<double>(truth.rgb.size()));
  for (std::size_t i = 0; i < truth.rgb.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double t = truth.rgb[i][c];
      error.largest_relative = std::max(error.largest_relative, std::abs(test.rgb[i][c] - t) / std::max(t, floor));
    }
  }
  return error;
}

DisplayError display_error(const Image& test, const Image& truth, std::span<const float> axis_distance_m) {
  require_same_size(test, truth);
  const std::size_t pixels = truth.rgba.size() / 4;
  DisplayError error;
  double squares = 0.0;
  std::size_t off = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double d = test.rgba[4 * i + c] - truth.rgba[4 * i + c];
      squares += d * d;
    }
    if (largest_difference(test, truth, i) > 2) ++off;
  }
  const double mse = squares / (3.0 * static_cast<double>(pixels));
  error.psnr_db = mse > 0.0 ? 10.0 * std::log10(255.0 * 255.0 / mse) : std::numeric_limits<double>::infinity();
  error.share_off = static_cast<double>(off) / static_cast<double>(pixels);
  error.ssim = mean_ssim(test, truth);
  for (const double value : flip(test, truth).values) error.flip += value / static_cast<double>(pixels);
  if (axis_distance_m.size() != pixels) return error;
  const std::vector<bool> near = near_edges(truth.width, truth.height, axis_distance_m);
  error.largest_at_edges = 0.0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!near[i]) continue;
    error.largest_at_edges = std::max(*error.largest_at_edges, static_cast<double>(largest_difference(test, truth, i)));
  }
  return error;
}

Image difference_image(const Image& test, const Image& truth, double gain) {
  require_same_size(test, truth);
  Image out{truth.width, truth.height, {}};
  for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
    if (i % 4 == 3) {
      out.rgba.push_back(255);
      continue;
    }
    const double value = 128.0 + gain * (test.rgba[i] - truth.rgba[i]);
    out.rgba.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))));
  }
  return out;
}

}  // namespace render
