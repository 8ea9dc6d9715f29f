#include "app/report/log_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace app {
namespace {

constexpr double kLeft = 70.0;
constexpr double kRight = 20.0;
constexpr double kTop = 20.0;
constexpr double kBottom = 50.0;

struct Axis {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool log = true;

  double value(double x) const { return log ? std::log10(x) : x; }
  void add(double x) {
    if (log && x <= 0.0) return;
    low = std::min(low, value(x));
    high = std::max(high, value(x));
  }
  // Whole decades, or a little room.
  void finish() {
    if (low > high) low = high = 0.0;
    if (log) {
      low = std::floor(low * 2.0 - 0.1) / 2.0;
      high = std::ceil(high * 2.0 + 0.1) / 2.0;
    } else {
      low -= 0.4;
      high += 0.4;
    }
  }
  double part(double x) const {
    if (log && x <= 0.0) return 0.0;
    return std::clamp((value(x) - low) / (high - low), 0.0, 1.0);
  }
};

class Plot {
 public:
  Plot(const std::vector<PlotSeries>& series, const PlotStyle& style) : series_(series), style_(style) {
    x_.log = style.log_x;
    for (const PlotSeries& s : series) {
      for (const PlotPoint& p : s.points) {
        x_.add(p.x);
        y_.add(p.y);
      }
    }
    x_.finish();
    y_.finish();
  }

  std::string svg() {
    out_ = fmt::format(
        "<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" font-size=\"12\">\n"
        "<rect x=\"{2}\" y=\"{3}\" width=\"{4}\" height=\"{5}\" fill=\"#fff\" stroke=\"#999\"/>\n",
        style_.width, style_.height, kLeft, kTop, style_.width - kLeft - kRight, style_.height - kTop - kBottom);
    grid();
    for (const PlotSeries& s : series_) draw(s);
    legend();
    out_ += "</svg>\n";
    return out_;
  }

 private:
  double px(double x) const { return kLeft + x_.part(x) * (style_.width - kLeft - kRight); }
  double py(double y) const { return style_.height - kBottom - y_.part(y) * (style_.height - kTop - kBottom); }

  void grid() {
    for (int d = static_cast<int>(std::ceil(y_.low)); d <= static_cast<int>(std::floor(y_.high)); ++d) {
      const double y = py(std::pow(10.0, d));
      out_ += fmt::format(
          "<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"#ddd\"/>"
          "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
          kLeft, style_.width - kRight, y, kLeft - 6.0, y + 4.0, fmt::format("{:g}", std::pow(10.0, d)));
    }
    if (x_.log) {
      for (int d = static_cast<int>(std::ceil(x_.low)); d <= static_cast<int>(std::floor(x_.high)); ++d) {
        const double x = px(std::pow(10.0, d));
        out_ += fmt::format(
            "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#ddd\"/>"
            "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
            x, kTop, style_.height - kBottom, style_.height - kBottom + 16.0, fmt::format("{:g}", std::pow(10.0, d)));
      }
    }
    out_ += fmt::format(
        "<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n"
        "<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        0.5 * (kLeft + style_.width - kRight), style_.height - 12, escaped(style_.x_title),
        0.5 * (kTop + style_.height - kBottom), escaped(style_.y_title));
  }

  void draw(const PlotSeries& series) {
    if (series.joined) {
      std::string path;
      for (const PlotPoint& p : series.points) {
        path += fmt::format("{}{:.1f} {:.1f} ", path.empty() ? "M" : "L", px(p.x), py(p.y));
      }
      out_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"{}/>\n", path, series.color,
                          series.dashed ? " stroke-dasharray=\"5 4\"" : "");
    }
    if (!series.dots) return;
    for (const PlotPoint& p : series.points) {
      if (p.ringed) {
        out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\" fill=\"none\" stroke=\"#000\"/>\n", px(p.x),
                            py(p.y));
      }
      out_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\"><title>{}</title></circle>\n",
                          px(p.x), py(p.y), series.color, escaped(p.label));
    }
  }

  void legend() {
    double y = kTop + 18.0;
    for (const PlotSeries& s : series_) {
      out_ += fmt::format(
          "<circle cx=\"{0}\" cy=\"{1}\" r=\"5\" fill=\"{2}\"/><text x=\"{3}\" y=\"{4}\" "
          "text-anchor=\"end\">{5}</text>\n",
          style_.width - kRight - 14.0, y - 4.0, s.color, style_.width - kRight - 26.0, y, escaped(s.name));
      y += 18.0;
    }
  }

  const std::vector<PlotSeries>& series_;
  PlotStyle style_;
  Axis x_;
  Axis y_;
  std::string out_;
};

}  // namespace

std::string log_plot(const std::vector<PlotSeries>& series, const PlotStyle& style) {
  return Plot(series, style).svg();
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace app
