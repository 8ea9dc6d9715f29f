#pragma once

#include <functional>
#include <vector>

namespace render {

// One channel of a picture, row 0 at the top.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<double> values;  // width * height

  double at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

// Weights for offsets -radius ... radius.
std::vector<double> kernel(int radius, const std::function<double(double offset)>& weight);
// Scaled so that they sum to 1; derivatives: so that the positive ones sum to 1 and the negative ones to -1.
void normalize(std::vector<double>& weights);
void normalize_signs(std::vector<double>& weights);

// Correlates rows with one kernel and columns with another; the picture's edge pixels go on for ever.
Plane filtered(const Plane& plane, const std::vector<double>& along_rows, const std::vector<double>& along_columns);

}  // namespace render
