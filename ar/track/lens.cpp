#include "ar/track/lens.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "ar/track/dual.h"

namespace ar {
namespace {

using Coefficients = std::array<double, 14>;

// Radial gain of OpenCV's plumb-bob and rational models at squared radius r2.
template <typename Scalar>
Scalar rational_gain(const Coefficients& k, const Scalar& r2) {
  const Scalar numerator = Scalar(1.0) + r2 * (Scalar(k[0]) + r2 * (Scalar(k[1]) + r2 * Scalar(k[4])));
  const Scalar denominator = Scalar(1.0) + r2 * (Scalar(k[5]) + r2 * (Scalar(k[6]) + r2 * Scalar(k[7])));
  return numerator / denominator;
}

// Distorted angle of the fisheye model of Kannala and Brandt (2006) as OpenCV writes it.
template <typename Scalar>
Scalar fisheye_angle(const Coefficients& k, const Scalar& theta) {
  const Scalar t2 = theta * theta;
  return theta * (Scalar(1.0) + t2 * (Scalar(k[0]) + t2 * (Scalar(k[1]) + t2 * (Scalar(k[2]) + t2 * Scalar(k[3])))));
}

template <typename Scalar>
struct Point {
  Scalar x;
  Scalar y;
};

template <typename Scalar>
Point<Scalar> distort_fisheye(const Coefficients& k, const Scalar& x, const Scalar& y) {
  using std::atan;
  using std::sqrt;
  const Scalar r2 = x * x + y * y;
  if (value_of(r2) < 1e-16) return {x, y};  // the gain is 1 + O(r2); sqrt has no derivative at 0
  const Scalar r = sqrt(r2);
  const Scalar gain = fisheye_angle(k, Scalar(atan(r))) / r;
  return {x * gain, y * gain};
}

// OpenCV's documentation of calib3d: radial (rational), tangential p1 p2, thin prism s1..s4, tilt of the sensor.
template <typename Scalar>
Point<Scalar> distort_rational(const Coefficients& k, const cv::Matx33d& tilt, bool tilted, const Scalar& x,
                               const Scalar& y) {
  const Scalar r2 = x * x + y * y;
  const Scalar gain = rational_gain(k, r2);
  const Scalar xy2 = Scalar(2.0) * x * y;
  const Scalar p1(k[2]);
  const Scalar p2(k[3]);
  const Scalar u = x * gain + p1 * xy2 + p2 * (r2 + Scalar(2.0) * x * x) + r2 * (Scalar(k[8]) + r2 * Scalar(k[9]));
  const Scalar v = y * gain + p2 * xy2 + p1 * (r2 + Scalar(2.0) * y * y) + r2 * (Scalar(k[10]) + r2 * Scalar(k[11]));
  if (!tilted) return {u, v};
  const Scalar w = Scalar(tilt(2, 0)) * u + Scalar(tilt(2, 1)) * v + Scalar(tilt(2, 2));
  return {(Scalar(tilt(0, 0)) * u + Scalar(tilt(0, 1)) * v + Scalar(tilt(0, 2))) / w,
          (Scalar(tilt(1, 0)) * u + Scalar(tilt(1, 1)) * v + Scalar(tilt(1, 2))) / w};
}

template <typename Scalar>
Point<Scalar> distort(LensModel lens, const Coefficients& k, const cv::Matx33d& tilt, bool tilted, const Scalar& x,
                      const Scalar& y) {
  if (lens == LensModel::None) return {x, y};
  if (lens == LensModel::Fisheye) return distort_fisheye(k, x, y);
  return distort_rational(k, tilt, tilted, x, y);
}

// The tilted sensor of OpenCV's 14-term model (Louhichi et al. 2007, equations 1 and 2).
cv::Matx33d tilt_matrix(double tau_x, double tau_y) {
  const cv::Matx33d about_x(1, 0, 0, 0, std::cos(tau_x), std::sin(tau_x), 0, -std::sin(tau_x), std::cos(tau_x));
  const cv::Matx33d about_y(std::cos(tau_y), 0, -std::sin(tau_y), 0, 1, 0, std::sin(tau_y), 0, std::cos(tau_y));
  const cv::Matx33d rotation = about_y * about_x;
  const cv::Matx33d onto_plane(rotation(2, 2), 0, -rotation(0, 2), 0, rotation(2, 2), -rotation(1, 2), 0, 0, 1);
  return onto_plane * rotation;
}

bool count_fits(LensModel lens, std::size_t count) {
  switch (lens) {
    case LensModel::None:
      return count == 0;
    case LensModel::PlumbBob:
      return count == 4 || count == 5;
    case LensModel::Rational:
      return count == 8 || count == 12 || count == 14;
    case LensModel::Fisheye:
      return count == 4;
  }
  return false;
}

}  // namespace

Lens::Lens(const CameraModel& camera) : lens_(camera.lens), intrinsics_(camera.intrinsics) {
  if (!count_fits(camera.lens, camera.distortion.size())) {
    throw std::runtime_error(
        fmt::format("camera {}: {} distortion coefficients do not fit its lens model\n"
                    "accepted: none 0, plumb_bob 4 or 5, rational 8, 12 or 14, fisheye 4",
                    camera.origin, camera.distortion.size()));
  }
  for (std::size_t i = 0; i < camera.distortion.size(); ++i) k_[i] = camera.distortion[i];
  bool finite = true;
  for (double v : intrinsics_.val) finite = finite && std::isfinite(v);
  for (double v : k_) finite = finite && std::isfinite(v);
  if (!finite || !(intrinsics_(0, 0) > 0.0) || !(intrinsics_(1, 1) > 0.0)) {
    throw std::runtime_error(
        fmt::format("camera {}: focal lengths {} and {} px are not those of a camera\n"
                    "they must be positive, and every coefficient finite",
                    camera.origin, intrinsics_(0, 0), intrinsics_(1, 1)));
  }
  tilted_ = camera.distortion.size() == 14 && (k_[12] != 0.0 || k_[13] != 0.0);
  if (tilted_) tilt_ = tilt_matrix(k_[12], k_[13]);
  max_ideal_radius_ = find_max_ideal_radius();
}

double Lens::radial(double r) const {
  if (lens_ == LensModel::None) return r;
  if (lens_ == LensModel::Fisheye) return fisheye_angle(k_, std::atan(r));
  return r * rational_gain(k_, r * r);
}

// Walks out in equal angles and stops before the radial function first fails to grow (a fold, or a pole of the rational
// model), then halves the last step. 89.9 degrees off the axis is the end: ideal coordinates grow without bound there.
double Lens::find_max_ideal_radius() const {
  if (lens_ == LensModel::None) return std::numeric_limits<double>::infinity();
  constexpr int kSteps = 4096;
  const double step = CV_PI * (89.9 / 180.0) / kSteps;
  const auto grows = [&](double angle) {
    const double here = std::tan(angle);
    const double ahead = std::tan(angle + 1e-6);
    return radial(ahead) > radial(here);
  };
  double good = 0.0;
  double previous = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double angle = step * i;
    const double value = radial(std::tan(angle));
    if (!(value > previous) || !grows(angle)) {
      double bad = angle;
      for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (good + bad);
        (grows(middle) && radial(std::tan(middle)) > 0.0 ? good : bad) = middle;
      }
      break;
    }
    good = angle;
    previous = value;
  }
  return std::tan(good);
}

double Lens::invert_radial(double radius) const {
  double low = 0.0;
  double high = std::atan(std::min(max_ideal_radius_, 1e6));
  for (int halving = 0; halving < 12; ++halving) {  // a start good enough for Newton's method
    const double middle = 0.5 * (low + high);
    (radial(std::tan(middle)) < radius ? low : high) = middle;
  }
  return std::tan(0.5 * (low + high));
}

std::optional<cv::Point2d> Lens::pixel_from_ideal(const cv::Point2d& ideal) const {
  if (!(std::hypot(ideal.x, ideal.y) <= max_ideal_radius_)) return std::nullopt;
  const Point<double> p = distort(lens_, k_, tilt_, tilted_, ideal.x, ideal.y);
  const cv::Point2d pixel(intrinsics_(0, 0) * p.x + intrinsics_(0, 1) * p.y + intrinsics_(0, 2),
                          intrinsics_(1, 1) * p.y + intrinsics_(1, 2));
  if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return std::nullopt;
  return pixel;
}

std::optional<cv::Point2d> Lens::project(const cv::Vec3d& point_in_camera, cv::Matx23d* jacobian) const {
  const double z = point_in_camera[2];
  if (!(z > 0.0)) return std::nullopt;
  const cv::Point2d ideal(point_in_camera[0] / z, point_in_camera[1] / z);
  const std::optional<cv::Point2d> pixel = pixel_from_ideal(ideal);
  if (!pixel || jacobian == nullptr) return pixel;
  const Point<Dual2> p = distort(lens_, k_, tilt_, tilted_, Dual2(ideal.x, 1.0, 0.0), Dual2(ideal.y, 0.0, 1.0));
  const cv::Matx22d pixel_by_distorted(intrinsics_(0, 0), intrinsics_(0, 1), 0.0, intrinsics_(1, 1));
  const cv::Matx22d distorted_by_ideal(p.x.dx, p.x.dy, p.y.dx, p.y.dy);
  const cv::Matx23d ideal_by_point(1.0 / z, 0.0, -ideal.x / z, 0.0, 1.0 / z, -ideal.y / z);
  *jacobian = pixel_by_distorted * distorted_by_ideal * ideal_by_point;
  return pixel;
}

std::optional<cv::Point2d> Lens::ideal_from_pixel(const cv::Point2d& pixel) const {
  if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return std::nullopt;
  const double v = (pixel.y - intrinsics_(1, 2)) / intrinsics_(1, 1);
  const double u = (pixel.x - intrinsics_(0, 2) - intrinsics_(0, 1) * v) / intrinsics_(0, 0);
  if (lens_ == LensModel::None) return cv::Point2d(u, v);

  const double radius = std::hypot(u, v);
  const double scale = radius > 0.0 ? invert_radial(radius) / radius : 1.0;
  double x = u * scale;
  double y = v * scale;
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Point<Dual2> p = distort(lens_, k_, tilt_, tilted_, Dual2(x, 1.0, 0.0), Dual2(y, 0.0, 1.0));
    const double ex = u - p.x.value;
    const double ey = v - p.y.value;
    const double determinant = p.x.dx * p.y.dy - p.x.dy * p.y.dx;
    if (!(determinant > 0.0)) return std::nullopt;  // on the fold or past it
    const bool within = std::hypot(x, y) <= max_ideal_radius_;
    if (ex * ex + ey * ey < 1e-22) return within ? std::optional(cv::Point2d(x, y)) : std::nullopt;
    const double step_x = (p.y.dy * ex - p.x.dy * ey) / determinant;
    const double step_y = (p.x.dx * ey - p.y.dx * ex) / determinant;
    // Near the fold a full step overshoots: no step may exceed half of the present radius.
    const double limit = 0.5 * std::hypot(x, y) + 1e-3;
    const double shrink = std::min(1.0, limit / std::max(std::hypot(step_x, step_y), 1e-300));
    x += shrink * step_x;
    y += shrink * step_y;
  }
  return std::nullopt;
}

}  // namespace ar
