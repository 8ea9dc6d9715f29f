#pragma once

#include <string>
#include <vector>

namespace app {

struct PlotPoint {
  double x = 0.0;
  double y = 0.0;
  std::string label;  // shown when pointed at
  bool ringed = false;
};

struct PlotSeries {
  std::string name;
  std::string color;  // as SVG reads it
  std::vector<PlotPoint> points;
  bool joined = true;
  bool dashed = false;
  bool dots = true;
};

// An SVG element of points on logarithmic axes (the x axis linear where asked for), decades labelled. Values that are
// not above 0 are put at the bottom.
struct PlotStyle {
  std::string x_title;
  std::string y_title;
  int width = 900;
  int height = 520;
  bool log_x = true;
};
std::string log_plot(const std::vector<PlotSeries>& series, const PlotStyle& style);

// The text with &, <, > and quotes as HTML has them.
std::string escaped(const std::string& text);

}  // namespace app
