#include "tests/bench/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace bench {
namespace {

constexpr double kWidth = 660.0;
constexpr double kHeight = 360.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 490.0;  // names stand to the right of it
constexpr double kTop = 40.0;
constexpr double kBottom = 310.0;
constexpr std::array<const char*, 8> kColors = {"#1b6ca8", "#d1495b", "#2e933c", "#8d5a97",
                                                "#edae49", "#444444", "#00a3a3", "#b06f00"};

// One axis: where a value stands between 0 and 1, and the ticks.
class Scale {
 public:
  Scale(const Axis& axis, const std::vector<double>& values) : logarithmic_(axis.logarithmic) {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (const double value : values) {
      if (!shows(value)) continue;
      low = std::min(low, inner(value));
      high = std::max(high, inner(value));
    }
    if (high <= low) high = low + 1.0;
    step_ = logarithmic_ ? 1.0 : nice_step((high - low) / 5.0);
    low_ = std::floor(low / step_ + 1e-9) * step_;
    high_ = std::ceil(high / step_ - 1e-9) * step_;
  }

  bool shows(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0.0); }
  double at(double value) const { return (inner(value) - low_) / (high_ - low_); }

  // Values of the ticks.
  std::vector<double> ticks() const {
    std::vector<double> list;
    const int count = static_cast<int>(std::lround((high_ - low_) / step_));
    for (int i = 0; i <= count; ++i) {
      const double tick = low_ + step_ * i;
      list.push_back(logarithmic_ ? std::pow(10.0, tick) : std::abs(tick) < 1e-12 ? 0.0 : tick);
    }
    return list;
  }

 private:
  double inner(double value) const { return logarithmic_ ? std::log10(value) : value; }
  static double nice_step(double rough) {
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (rough <= factor * decade) return factor * decade;
    }
    return 10.0 * decade;
  }

  bool logarithmic_;
  double step_ = 1.0;
  double low_ = 0.0;
  double high_ = 1.0;
};

double page_x(const Scale& scale, double value) {
  return kLeft + scale.at(value) * (kRight - kLeft);
}

double page_y(const Scale& scale, double value) {
  return kBottom - scale.at(value) * (kBottom - kTop);
}

std::string text(double x, double y, const std::string& anchor, const std::string& words) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, words);
}

std::string frame(const std::string& title, const Axis& x_axis, const Axis& y_axis, const Scale& x, const Scale& y) {
  std::string out;
  for (const double tick : x.ticks()) {
    out += fmt::format("<path d=\"M{0:.1f} {1} V{2}\" stroke=\"#ddd\"/>\n", page_x(x, tick), kTop, kBottom);
    out += text(page_x(x, tick), kBottom + 16.0, "middle", fmt::format("{:g}", tick));
  }
  for (const double tick : y.ticks()) {
    out += fmt::format("<path d=\"M{1} {0:.1f} H{2}\" stroke=\"#ddd\"/>\n", page_y(y, tick), kLeft, kRight);
    out += text(kLeft - 6.0, page_y(y, tick) + 4.0, "end", fmt::format("{:g}", tick));
  }
  out += text(kLeft, 24.0, "start", fmt::format("<tspan font-weight=\"bold\">{}</tspan>", title));
  out += text(0.5 * (kLeft + kRight), kBottom + 36.0, "middle", x_axis.label);
  out += fmt::format("<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     0.5 * (kTop + kBottom), y_axis.label);
  return out;
}

std::string drawn(const Series& series, const char* color, const Scale& x, const Scale& y) {
  std::string out;
  std::string path;
  for (const auto& [px, py] : series.points) {
    if (!x.shows(px) || !y.shows(py)) continue;
    path += fmt::format("{}{:.1f} {:.1f} ", path.empty() ? "M" : "L", page_x(x, px), page_y(y, py));
    if (series.line && series.points.size() > 20) continue;
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", page_x(x, px), page_y(y, py),
                       color);
    if (!series.line) out += text(page_x(x, px) + 7.0, page_y(y, py) + 4.0, "start", series.name);
  }
  if (series.line)
    out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"/>\n", path, color);
  return out;
}

}  // namespace

std::string svg_plot(const std::string& title, const Axis& x_axis, const Axis& y_axis,
                     const std::vector<Series>& series) {
  std::vector<double> xs;
  std::vector<double> ys;
  for (const Series& one : series) {
    for (const auto& [px, py] : one.points) {
      xs.push_back(px);
      ys.push_back(py);
    }
  }
  const Scale x(x_axis, xs);
  const Scale y(y_axis, ys);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
      kWidth, kHeight);
  out += frame(title, x_axis, y_axis, x, y);
  double key_y = kTop + 8.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const char* color = kColors[i % kColors.size()];
    out += drawn(series[i], color, x, y);
    if (!series[i].line) continue;
    out +=
        fmt::format("<path d=\"M{0} {1:.1f} h16\" stroke=\"{2}\" stroke-width=\"3\"/>\n", kRight + 10.0, key_y, color);
    out += text(kRight + 31.0, key_y + 4.0, "start", series[i].name);
    key_y += 18.0;
  }
  return out + "</svg>\n";
}

}  // namespace bench
