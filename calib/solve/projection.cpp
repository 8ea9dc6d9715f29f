#include "calib/solve/projection.h"

#include <cmath>

namespace calib {
namespace {

constexpr double kNearAxis = 1e-6;     // r2 below which the fisheye's series is exact to double precision
constexpr double kSmallTurn = 1e-4;    // rad below which the series of sine and cosine are
constexpr std::size_t kMostTerms = 8;  // of distortion

// A gain of the radius, its derivative by r2, and by the distortion terms in their order.
struct Gain {
  double value = 1.0;
  double by_r2 = 0.0;
  std::array<double, kMostTerms> by_term{};
};

Gain radial_gain(LensChoice choice, const double* k, double r2) {
  const bool rational = choice == LensChoice::Rational8;
  const double k3 = rational || choice == LensChoice::PlumbBob5 ? k[4] : 0.0;
  const double numerator = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k3));
  const double slope = k[0] + r2 * (2.0 * k[1] + r2 * 3.0 * k3);
  const double denominator = rational ? 1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])) : 1.0;
  Gain gain;
  gain.value = numerator / denominator;
  gain.by_r2 = slope / denominator;
  gain.by_term[0] = r2 / denominator;
  gain.by_term[1] = r2 * r2 / denominator;
  gain.by_term[4] = r2 * r2 * r2 / denominator;
  if (!rational) return gain;
  gain.by_r2 -= gain.value * (k[5] + r2 * (2.0 * k[6] + r2 * 3.0 * k[7])) / denominator;
  gain.by_term[5] = -gain.value * gain.by_term[0];
  gain.by_term[6] = -gain.value * gain.by_term[1];
  gain.by_term[7] = -gain.value * gain.by_term[4];
  return gain;
}

// The angle's radius over the tangent's, of Kannala and Brandt (2006) as OpenCV writes it.
Gain fisheye_gain(const double* k, double r2) {
  Gain gain;
  if (r2 < kNearAxis) {
    gain.by_r2 = k[0] - 1.0 / 3.0;
    gain.value = 1.0 + gain.by_r2 * r2;
    gain.by_term[0] = r2;
    return gain;
  }
  const double r = std::sqrt(r2);
  const double theta = std::atan(r);
  const double t2 = theta * theta;
  gain.value = theta * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3])))) / r;
  const double by_theta = 1.0 + t2 * (3.0 * k[0] + t2 * (5.0 * k[1] + t2 * (7.0 * k[2] + t2 * 9.0 * k[3])));
  gain.by_r2 = (by_theta / (1.0 + r2) - gain.value) / (2.0 * r2);
  double power = theta / r;
  for (std::size_t i = 0; i < 4; ++i) gain.by_term[i] = power *= t2;
  return gain;
}

bool has_tangential(LensChoice choice) {
  return choice == LensChoice::PlumbBob4 || choice == LensChoice::PlumbBob5 || choice == LensChoice::Rational8;
}

// The distorted place of a ray, with derivatives by its ideal place and by the distortion terms.
struct Distorted {
  double x = 0.0;
  double y = 0.0;
  cv::Matx22d by_ideal;
  std::array<double, kMostTerms> x_by_term{};
  std::array<double, kMostTerms> y_by_term{};
};

Distorted distorted(LensChoice choice, const double* k, double x, double y) {
  const double r2 = x * x + y * y;
  const Gain gain = choice == LensChoice::Pinhole    ? Gain{}
                    : choice == LensChoice::Fisheye4 ? fisheye_gain(k, r2)
                                                     : radial_gain(choice, k, r2);
  const double g = gain.value;
  const double slope = 2.0 * gain.by_r2;
  Distorted d{x * g, y * g, {g + slope * x * x, slope * x * y, slope * x * y, g + slope * y * y}, {}, {}};
  for (std::size_t i = 0; i < kMostTerms; ++i) {
    d.x_by_term.at(i) = x * gain.by_term.at(i);
    d.y_by_term.at(i) = y * gain.by_term.at(i);
  }
  if (!has_tangential(choice)) return d;
  const double p1 = k[2];
  const double p2 = k[3];
  d.x_by_term[2] = d.y_by_term[3] = 2.0 * x * y;
  d.x_by_term[3] = r2 + 2.0 * x * x;
  d.y_by_term[2] = r2 + 2.0 * y * y;
  d.x += p1 * d.x_by_term[2] + p2 * d.x_by_term[3];
  d.y += p1 * d.y_by_term[2] + p2 * d.y_by_term[3];
  const double mixed = 2.0 * (p1 * x + p2 * y);
  d.by_ideal += cv::Matx22d(2.0 * p1 * y + 6.0 * p2 * x, mixed, mixed, 6.0 * p1 * y + 2.0 * p2 * x);
  return d;
}

void fill_by_intrinsics(LensChoice choice, const double* v, const Distorted& d, double* out) {
  const int count = intrinsics_count(choice);
  double* row0 = out;
  double* row1 = out + count;
  const double first0[] = {d.x, 0.0, 1.0, 0.0};
  const double first1[] = {0.0, d.y, 0.0, 1.0};
  for (int i = 0; i < 4; ++i) {
    row0[i] = first0[i];
    row1[i] = first1[i];
  }
  for (int i = 4; i < count; ++i) {
    row0[i] = v[0] * d.x_by_term.at(static_cast<std::size_t>(i) - 4);
    row1[i] = v[1] * d.y_by_term.at(static_cast<std::size_t>(i) - 4);
  }
}

}  // namespace

bool project_point(LensChoice choice, const double* v, const double* point, double* pixel, double* by_intrinsics,
                   double* by_point) {
  if (point[2] <= 0.0) return false;
  const double inverse = 1.0 / point[2];
  const double x = point[0] * inverse;
  const double y = point[1] * inverse;
  const Distorted d = distorted(choice, v + 4, x, y);
  pixel[0] = v[0] * d.x + v[2];
  pixel[1] = v[1] * d.y + v[3];
  if (by_intrinsics != nullptr) fill_by_intrinsics(choice, v, d, by_intrinsics);
  if (by_point == nullptr) return true;
  for (int row = 0; row < 2; ++row) {
    const double by_x = v[row] * d.by_ideal(row, 0) * inverse;
    const double by_y = v[row] * d.by_ideal(row, 1) * inverse;
    by_point[3 * row] = by_x;
    by_point[3 * row + 1] = by_y;
    by_point[3 * row + 2] = -(by_x * x + by_y * y);
  }
  return true;
}

PoseNumbers numbers_of(const ar::Rigid3& pose) {
  const cv::Vec3d turn = ar::vector_from_rotation(pose.rotation);
  const cv::Vec3d& shift = pose.translation;
  return {turn[0], turn[1], turn[2], shift[0], shift[1], shift[2]};
}

ar::Rigid3 pose_of(const PoseNumbers& p) {
  return {ar::rotation_from_vector({p[0], p[1], p[2]}), {p[3], p[4], p[5]}};
}

Turn::Turn(const double* vector) {
  const cv::Vec3d w(vector[0], vector[1], vector[2]);
  const double square = w.dot(w);
  const double angle = std::sqrt(square);
  const bool small = angle < kSmallTurn;
  const double a = small ? 1.0 - square / 6.0 : std::sin(angle) / angle;
  const double b = small ? 0.5 - square / 24.0 : (1.0 - std::cos(angle)) / square;
  const double c = small ? 1.0 / 6.0 - square / 120.0 : (1.0 - a) / square;
  const cv::Matx33d cross = ar::cross_matrix(w);
  const cv::Matx33d twice = cross * cross;
  rotation = cv::Matx33d::eye() + a * cross + b * twice;
  left = cv::Matx33d::eye() + b * cross + c * twice;
}

cv::Matx33d Turn::by_vector(const cv::Vec3d& turned) const {
  return ar::cross_matrix(turned) * left * -1.0;
}

cv::Vec3d transformed(const double* pose, const cv::Vec3d& in_a, cv::Matx<double, 3, 6>* by_pose,
                      cv::Matx33d* by_point) {
  const Turn turn(pose);
  const cv::Vec3d turned = turn.rotation * in_a;
  if (by_point != nullptr) *by_point = turn.rotation;
  if (by_pose != nullptr) {
    const cv::Matx33d by_turn = turn.by_vector(turned);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        (*by_pose)(row, column) = by_turn(row, column);
        (*by_pose)(row, column + 3) = row == column ? 1.0 : 0.0;
      }
    }
  }
  return turned + cv::Vec3d(pose[3], pose[4], pose[5]);
}

}  // namespace calib
