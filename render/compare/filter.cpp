#include "render/compare/filter.h"

#include <algorithm>
#include <cmath>

namespace render {

std::vector<double> kernel(int radius, const std::function<double(double offset)>& weight) {
  std::vector<double> weights;
  for (int i = -radius; i <= radius; ++i) weights.push_back(weight(i));
  return weights;
}

void normalize(std::vector<double>& weights) {
  double sum = 0.0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w /= sum;
}

void normalize_signs(std::vector<double>& weights) {
  double above = 0.0;
  double below = 0.0;
  for (const double w : weights) (w > 0.0 ? above : below) += std::abs(w);
  for (double& w : weights) w /= w > 0.0 ? above : below;
}

Plane filtered(const Plane& plane, const std::vector<double>& along_rows, const std::vector<double>& along_columns) {
  Plane rows{plane.width, plane.height, std::vector<double>(plane.values.size())};
  Plane out = rows;
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(plane.width) + static_cast<std::size_t>(x);
  };
  const int row_radius = static_cast<int>(along_rows.size() / 2);
  const int column_radius = static_cast<int>(along_columns.size() / 2);
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      double sum = 0.0;
      for (int i = -row_radius; i <= row_radius; ++i) {
        sum +=
            along_rows[static_cast<std::size_t>(i + row_radius)] * plane.at(std::clamp(x + i, 0, plane.width - 1), y);
      }
      rows.values[index(x, y)] = sum;
    }
  }
  for (int y = 0; y < plane.height; ++y) {
    for (int i = -column_radius; i <= column_radius; ++i) {
      const double weight = along_columns[static_cast<std::size_t>(i + column_radius)];
      const std::size_t from = index(0, std::clamp(y + i, 0, plane.height - 1));
      for (std::size_t x = 0; x < static_cast<std::size_t>(plane.width); ++x) {
        out.values[index(0, y) + x] += weight * rows.values[from + x];
      }
    }
  }
  return out;
}

}  // namespace render
