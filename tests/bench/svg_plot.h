#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bench {

struct Series {
  std::string name;
  std::vector<std::pair<double, double>> points;
  bool line = true;  // joined, or marks with their name beside them
};

struct Axis {
  std::string label;
  bool logarithmic = false;
};

// A small chart as SVG, its axes fitted to the points. Points that a logarithmic axis cannot show are left out.
std::string svg_plot(const std::string& title, const Axis& x, const Axis& y, const std::vector<Series>& series);

}  // namespace bench
