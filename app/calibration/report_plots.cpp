#include "app/calibration/report_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/report/log_plot.h"
#include "ar/track/lens.h"

namespace app {
namespace {

constexpr int kMostArrows = 3000;
constexpr int kMargin = 26;  // px around a picture, for its axes

std::string view_color(std::size_t view) {
  // Golden angle: neighbours in the list differ most.
  return fmt::format("hsl({:.0f} 70% 42%)", std::fmod(static_cast<double>(view) * 137.508, 360.0));
}

// A picture's frame, its pixels scaled to the page.
class PictureFrame {
 public:
  PictureFrame(const Calibration& c, int width)
      : width_(width),
        scale_(static_cast<double>(width) / c.gathered.observations.width),
        height_(scale_ * c.gathered.observations.height) {
    text_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {:.0f}\" width=\"{}\" height=\"{:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"11\">\n<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{:.1f}\" "
        "fill=\"#fff\" stroke=\"#888\"/>\n",
        width + 2 * kMargin, height_ + 2 * kMargin, width + 2 * kMargin, height_ + 2 * kMargin, kMargin, kMargin, width,
        height_);
    label(kMargin, kMargin - 6, "0, 0");
    label(kMargin + width - 60, kMargin + height_ + 14,
          fmt::format("{}, {}", c.gathered.observations.width, c.gathered.observations.height));
  }
  double x(double px) const { return kMargin + (px + 0.5) * scale_; }
  double y(double px) const { return kMargin + (px + 0.5) * scale_; }
  double scale() const { return scale_; }
  void label(double at_x, double at_y, const std::string& words) {
    text_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#444\">{}</text>\n", at_x, at_y, escaped(words));
  }
  void add(const std::string& element) { text_ += element; }
  void caption(const std::string& words) { label(kMargin, kMargin + height_ + 14, words); }
  std::string svg() const { return text_ + "</svg>\n"; }

 private:
  int width_;
  double scale_;
  double height_;
  std::string text_;
};

template <typename Visit>
void for_each_corner(const Calibration& c, const Visit& visit) {
  for (std::size_t v = 0; v < c.solution.views.size(); ++v) {
    for (std::size_t i = 0; i < c.solution.views[v].used.size(); ++i) {
      visit(v, c.gathered.observations.views[v].px[i], c.solution.views[v].residual_px[i], c.solution.views[v].used[i]);
    }
  }
}

std::string cross(double x, double y) {
  return fmt::format("<path d=\"M{0:.1f} {1:.1f}l6 6m0 -6l-6 6\" stroke=\"#d00\" stroke-width=\"1.4\"/>\n", x - 3.0,
                     y - 3.0);
}

std::string open_square(int side) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {0}\" width=\"{0}\" height=\"{0}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n",
      side);
}

// From blue through yellow to red, t from 0 to 1.
std::string heat_color(double t) {
  const double hue = 220.0 * (1.0 - std::clamp(t, 0.0, 1.0));
  return fmt::format("hsl({:.0f} 75% 60%)", hue);
}

// 1, 2 or 5 times a power of ten, at least v.
double round_up(double v) {
  const double decade = std::pow(10.0, std::floor(std::log10(std::max(v, 1e-9))));
  for (double m : {1.0, 2.0, 5.0}) {
    if (m * decade >= v) return m * decade;
  }
  return 10.0 * decade;
}

}  // namespace

std::string coverage_plot(const Calibration& c, int width) {
  PictureFrame frame(c, width);
  for_each_corner(c, [&](std::size_t v, const cv::Point2d& px, const cv::Point2d&, bool used) {
    frame.add(used ? fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.8\" fill=\"{}\"/>\n", frame.x(px.x),
                                 frame.y(px.y), view_color(v))
                   : cross(frame.x(px.x), frame.y(px.y)));
  });
  frame.caption("each colour is a view; crosses were left out");
  return frame.svg();
}

std::string residual_plot(const Calibration& c, int width) {
  PictureFrame frame(c, width);
  // The usual residual is drawn ten px of the page long.
  const double gain = 10.0 / std::max(1e-6, c.solution.rms_px);
  const int every = 1 + c.solution.points_used / kMostArrows;
  int index = 0;
  for_each_corner(c, [&](std::size_t, const cv::Point2d& px, const cv::Point2d& off, bool used) {
    if (!used || index++ % every != 0) return;
    const double x = frame.x(px.x);
    const double y = frame.y(px.y);
    const double red = std::min(1.0, cv::norm(off) / (3.0 * c.solution.rms_px));
    frame.add(
        fmt::format("<path d=\"M{:.1f} {:.1f}l{:.1f} {:.1f}\" stroke=\"{}\"/><circle cx=\"{:.1f}\" cy=\"{:.1f}\" "
                    "r=\"1\"/>\n",
                    x, y, gain * off.x, gain * off.y, heat_color(red), x, y));
  });
  frame.caption(fmt::format("10 px of this page are {:.3f} px (the RMS)", c.solution.rms_px));
  return frame.svg();
}

std::string uncertainty_plot(const Calibration& c, int width) {
  PictureFrame frame(c, width);
  const calib::Grid& grid = c.assessment.grid;
  const double full = round_up(std::max(1e-3, 4.0 * c.assessment.sigma_typical_px));
  const double cell_width = frame.scale() * grid.width / grid.columns;
  const double cell_height = frame.scale() * grid.height / grid.rows;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const double sigma = c.assessment.sigma_px[i];
    const cv::Point2d middle = grid.middle(i);
    const double x = frame.x(middle.x);
    const double y = frame.y(middle.y);
    const std::string color = std::isnan(sigma) ? "#ccc" : heat_color(sigma / full);
    frame.add(
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\" "
                    "stroke=\"#fff\" stroke-width=\"0.5\"/>\n",
                    x - 0.5 * cell_width, y - 0.5 * cell_height, cell_width, cell_height, color));
    frame.add(fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"9\" text-anchor=\"middle\">{}</text>\n", x,
                          y + 3.0, std::isnan(sigma) ? "-" : fmt::format("{:.2g}", sigma)));
    if (c.assessment.corners[i] == 0) {
      frame.add(fmt::format("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"#333\" stroke-width=\"1\"/>\n", x - 8.0,
                            y + 7.0, 16.0));
    }
  }
  frame.caption("px, one standard deviation; underlined: no corners there");
  return frame.svg();
}

std::string distortion_plot(const Calibration& c, int width) {
  PictureFrame frame(c, width);
  const ar::Lens lens(c.solution.camera);
  const cv::Matx33d& k = c.solution.camera.intrinsics;
  const int w = c.solution.camera.width;
  const int h = c.solution.camera.height;
  constexpr int kLines = 12;
  constexpr int kSteps = 48;
  const auto line = [&](bool across, int number) {
    std::string path;
    for (int i = 0; i <= kSteps; ++i) {
      const double along = static_cast<double>(i) / kSteps;
      const double other = static_cast<double>(number) / kLines;
      const cv::Point2d pinhole((across ? along : other) * w - 0.5, (across ? other : along) * h - 0.5);
      const auto px = lens.pixel_from_ideal({(pinhole.x - k(0, 2)) / k(0, 0), (pinhole.y - k(1, 2)) / k(1, 1)});
      const bool inside = px && px->x >= -0.5 && px->y >= -0.5 && px->x <= w - 0.5 && px->y <= h - 0.5;
      if (!inside) {
        if (!path.empty() && path.back() != ' ') path += ' ';
        continue;
      }
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() || path.back() == ' ' ? "M" : "L", frame.x(px->x),
                          frame.y(px->y));
    }
    if (!path.empty()) frame.add(fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#0072b2\"/>\n", path));
  };
  for (int i = 0; i <= kLines; ++i) {
    line(true, i);
    line(false, i);
  }
  frame.add(fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"#d55e00\"/>\n", frame.x(k(0, 2)),
                        frame.y(k(1, 2))));
  frame.caption("where this lens takes the straight grid of a pinhole; the dot is the principal point");
  return frame.svg();
}

std::string scatter_plot(const Calibration& c) {
  constexpr int kSide = 320;
  const double full = round_up(4.0 * std::max(1e-4, c.solution.rms_px));
  const double scale = 0.5 * (kSide - 40) / full;
  const double middle = 0.5 * kSide;
  std::string svg = open_square(kSide);
  svg += fmt::format("<path d=\"M20 {0}H{1}M{0} 20V{1}\" stroke=\"#bbb\"/>\n", middle, kSide - 20);
  for_each_corner(c, [&](std::size_t v, const cv::Point2d&, const cv::Point2d& off, bool used) {
    const double x = middle + scale * std::clamp(off.x, -full, full);
    const double y = middle + scale * std::clamp(off.y, -full, full);
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    svg += used ? fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"1.4\" fill=\"{}\"/>\n", x, y, view_color(v))
                : cross(x, y);
  });
  svg += fmt::format("<circle cx=\"{0}\" cy=\"{0}\" r=\"{1:.1f}\" fill=\"none\" stroke=\"#000\"/>\n", middle,
                     scale * c.solution.rms_px);
  svg += fmt::format("<text x=\"{}\" y=\"{}\">{:g} px</text><text x=\"22\" y=\"{}\">circle: RMS</text>\n", kSide - 58,
                     middle - 4, full, kSide - 8);
  return svg + "</svg>\n";
}

std::string tilt_plot(const Calibration& c) {
  constexpr int kSide = 320;
  const double middle = 0.5 * kSide;
  const double scale = (middle - 24.0) / 60.0;  // px per degree
  std::string svg = open_square(kSide);
  for (int ring = 15; ring <= 60; ring += 15) {
    svg += fmt::format(
        "<circle cx=\"{0}\" cy=\"{0}\" r=\"{1:.1f}\" fill=\"none\" stroke=\"#ccc\"/><text x=\"{2:.1f}\" "
        "y=\"{3}\" fill=\"#888\">{4}&#176;</text>\n",
        middle, scale * ring, middle + scale * ring - 20.0, middle - 2, ring);
  }
  double nearest = 1e30;
  for (const calib::ViewGeometry& view : c.assessment.views) {
    if (view.used) nearest = std::min(nearest, view.distance_m);
  }
  for (std::size_t v = 0; v < c.assessment.views.size(); ++v) {
    const calib::ViewGeometry& view = c.assessment.views[v];
    if (!view.used) continue;
    const double radius = scale * std::min(60.0, view.tilt_rad * 180.0 / std::numbers::pi);
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\" fill-opacity=\"0.75\"><title>{}: {:.2f} "
        "m</title></circle>\n",
        middle + radius * std::cos(view.direction_rad), middle + radius * std::sin(view.direction_rad),
        2.0 + 7.0 * nearest / view.distance_m, view_color(v), escaped(c.gathered.observations.views[v].name),
        view.distance_m);
  }
  svg += fmt::format("<text x=\"8\" y=\"{}\">large: near; where the board's normal points</text>\n", kSide - 6);
  return svg + "</svg>\n";
}

std::string view_bars(const Calibration& c) {
  constexpr int kRow = 16;
  constexpr int kNames = 230;
  constexpr int kWidth = 820;
  double largest = 1e-6;
  for (const calib::ViewFit& view : c.solution.views) largest = std::max(largest, view.rms_px);
  const int height = kRow * static_cast<int>(c.solution.views.size()) + 8;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n",
      kWidth, height);
  for (std::size_t v = 0; v < c.solution.views.size(); ++v) {
    const calib::ViewFit& fit = c.solution.views[v];
    const calib::Observation& view = c.gathered.observations.views[v];
    const double length = (kWidth - kNames - 200) * fit.rms_px / largest;
    const double y = kRow * static_cast<double>(v) + 4.0;
    const auto left_out = std::count(fit.used.begin(), fit.used.end(), false);
    std::string name = view.name;
    if (name.size() > 36) name = "..." + name.substr(name.size() - 33);
    svg += fmt::format(
        "<text x=\"{}\" y=\"{:.0f}\" text-anchor=\"end\">{}</text><rect x=\"{}\" y=\"{:.0f}\" "
        "width=\"{:.1f}\" height=\"{}\" fill=\"{}\"/><text x=\"{:.1f}\" y=\"{:.0f}\">{:.3f} px, {} "
        "corners{}</text>\n",
        kNames - 6, y + 11.0, escaped(name), kNames, y, length, kRow - 4, view_color(v), kNames + length + 6.0,
        y + 11.0, fit.rms_px, fit.used.size(), left_out > 0 ? fmt::format(", {} left out", left_out) : "");
  }
  return svg + "</svg>\n";
}

}  // namespace app
