#include "calib/solve/weak_direction.h"

#include <cmath>
#include <optional>
#include <vector>

#include "calib/solve/linear.h"
#include "calib/solve/projection.h"

namespace calib {
namespace {

constexpr double kRise = 9.0;       // of the sum of squares, in variances: three standard deviations
constexpr double kFarthest = 64.0;  // in linear reaches
constexpr double kStraightEnough = 1.05;

cv::Mat_<double> column_of(const std::vector<double>& values) {
  return cv::Mat_<double>(values, true);
}

// The corners' places as functions of the intrinsics alone, the poses' first-order effect projected out.
class CornerField {
 public:
  explicit CornerField(const Bundle& bundle) : bundle_(bundle), n_(static_cast<int>(bundle.intrinsics.size())) {
    for (std::size_t v = 0; v < bundle.views.size(); ++v) add_view(v);
    reference_ = evaluate(column_of(bundle.intrinsics), nullptr);
  }

  // Change of all corners against the solution; by_intrinsics receives its derivatives.
  cv::Mat_<double> change(const cv::Mat_<double>& intrinsics, cv::Mat_<double>* by_intrinsics) const {
    cv::Mat_<double> moved = evaluate(intrinsics, by_intrinsics);
    moved -= reference_;
    int row = 0;
    for (const View& view : views_) {
      const cv::Range rows(row, row + 2 * static_cast<int>(view.points.size()));
      project_out(view.poses, moved.rowRange(rows));
      if (by_intrinsics != nullptr) project_out(view.poses, by_intrinsics->rowRange(rows));
      row = rows.end;
    }
    return moved;
  }
  bool empty() const { return views_.empty(); }

 private:
  struct View {
    std::vector<cv::Vec3d> points;  // in the camera's frame
    cv::Mat_<double> poses;         // orthonormal basis of what a change of the pose does to the corners
  };

  static void project_out(const cv::Mat_<double>& basis, cv::Mat_<double> columns) {
    cv::gemm(basis, transposed_product(basis, columns), -1.0, columns, 1.0, columns);
  }

  void add_view(std::size_t v) {
    View view;
    cv::Mat_<double> by_pose(0, 6);
    const auto& pose = bundle_.poses[v];
    for (std::size_t i = 0; i < bundle_.px[v].size(); ++i) {
      if (!bundle_.used[v][i]) continue;
      const auto point = static_cast<std::size_t>(bundle_.views[v]->points[i]);
      cv::Matx<double, 3, 6> point_by_pose;
      view.points.push_back(transformed(pose.data(), bundle_.point_on_board(point), &point_by_pose));
      by_pose.push_back(cv::Mat(pose_derivative(view.points.back(), point_by_pose)));
    }
    if (view.points.size() < 4) return;
    view.poses = orthonormal_columns(by_pose);
    views_.push_back(std::move(view));
  }

  cv::Matx<double, 2, 6> pose_derivative(const cv::Vec3d& point, const cv::Matx<double, 3, 6>& by_pose) const {
    double px[2];
    cv::Matx23d by_point;
    if (!project_point(bundle_.lens, bundle_.intrinsics.data(), point.val, px, nullptr, by_point.val)) return {};
    return by_point * by_pose;
  }

  cv::Mat_<double> evaluate(const cv::Mat_<double>& intrinsics, cv::Mat_<double>* by_intrinsics) const {
    int rows = 0;
    for (const View& view : views_) rows += 2 * static_cast<int>(view.points.size());
    cv::Mat_<double> out(rows, 1, 0.0);
    if (by_intrinsics != nullptr) *by_intrinsics = cv::Mat_<double>(rows, n_, 0.0);
    int row = 0;
    for (const View& view : views_) {
      for (const cv::Vec3d& point : view.points) {
        project_point(bundle_.lens, intrinsics[0], point.val, out[row],
                      by_intrinsics != nullptr ? (*by_intrinsics)[row] : nullptr);
        row += 2;
      }
    }
    return out;
  }

  const Bundle& bundle_;
  int n_;
  std::vector<View> views_;
  cv::Mat_<double> reference_;
};

// Scaled coordinates y of the intrinsics, theta = solution + scale * y, and the weakest direction in them. Columns.
struct WeakAxis {
  cv::Mat_<double> solution;
  cv::Mat_<double> scale;
  cv::Mat_<double> direction;  // unit
  cv::Mat_<double> others;     // its orthogonal complement
  double sigma = 0.0;          // linear standard deviation along it

  cv::Mat_<double> intrinsics_at(const cv::Mat_<double>& y) const {
    cv::Mat_<double> out;
    cv::multiply(scale, y, out);
    out += solution;
    return out;
  }
};

WeakAxis weakest(const Bundle& bundle, const cv::Mat_<double>& covariance) {
  WeakAxis axis;
  axis.solution = column_of(bundle.intrinsics);
  cv::sqrt(covariance.diag(), axis.scale);
  cv::Mat_<double> units;
  cv::gemm(axis.scale, axis.scale, 1.0, cv::noArray(), 0.0, units, cv::GEMM_2_T);
  cv::Mat_<double> correlation;
  cv::divide(covariance, units, correlation);
  const SymmetricEigen eigen = symmetric_eigen(correlation);
  const int n = covariance.rows;
  axis.direction = eigen.vectors.col(n - 1).clone();
  axis.others = eigen.vectors.colRange(0, n - 1).clone();
  axis.sigma = std::sqrt(eigen.values(n - 1));
  return axis;
}

// Smallest sum of squares, px2, with the coordinate along the axis held at t; `y` is the start and receives the place.
double held_at(const CornerField& field, const WeakAxis& axis, double t, cv::Mat_<double>& y) {
  cv::scaleAdd(axis.direction, t - axis.direction.dot(y), y, y);
  cv::Mat_<double> along = axis.others.clone();
  for (int r = 0; r < along.rows; ++r) along.row(r) *= axis.scale(r);
  double squares = 0.0;
  for (int iteration = 0; iteration < 8; ++iteration) {
    cv::Mat_<double> by_intrinsics;
    const cv::Mat_<double> moved = field.change(axis.intrinsics_at(y), &by_intrinsics);
    const double before = squares;
    squares = moved.dot(moved);
    if (!std::isfinite(squares)) return std::numeric_limits<double>::infinity();
    if (iteration > 1 && std::abs(before - squares) <= 1e-3 * squares) break;
    const cv::Mat_<double> jacobian = product(by_intrinsics, along);
    y -= product(axis.others,
                 solve_symmetric(transposed_product(jacobian, jacobian), transposed_product(jacobian, moved)));
  }
  return squares;
}

// The place towards `side` where the sum of squares has risen by kRise variances; nothing where it rises as fast as
// the derivatives say.
std::optional<cv::Mat_<double>> reach(const CornerField& field, const WeakAxis& axis, double side, double variance) {
  const double linear = std::sqrt(kRise) * axis.sigma;
  cv::Mat_<double> y(axis.direction.rows, 1, 0.0);
  double inside = 0.0;
  double outside = linear * kStraightEnough;
  cv::Mat_<double> inside_y = y.clone();
  while (held_at(field, axis, side * outside, y) < kRise * variance) {
    inside = outside;
    inside_y = y.clone();
    outside *= 1.6;
    if (outside > kFarthest * linear) return inside_y;
  }
  if (inside == 0.0) return std::nullopt;
  for (int halving = 0; halving < 4; ++halving) {
    const double middle = 0.5 * (inside + outside);
    y = inside_y.clone();
    if (held_at(field, axis, side * middle, y) < kRise * variance) {
      inside = middle;
      inside_y = y.clone();
    } else {
      outside = middle;
    }
  }
  return inside_y;
}

}  // namespace

cv::Mat_<double> widened_along_weakest(const Bundle& bundle, const cv::Mat_<double>& covariance, double sigma_px) {
  const CornerField field(bundle);
  if (field.empty() || !all_finite(covariance)) return covariance;
  for (int i = 0; i < covariance.rows; ++i) {
    if (!(covariance(i, i) > 0.0)) return covariance;
  }
  const WeakAxis axis = weakest(bundle, covariance);
  cv::Mat_<double> farthest(covariance.rows, 1, 0.0);
  for (double side : {-1.0, 1.0}) {
    const auto place = reach(field, axis, side, sigma_px * sigma_px);
    if (place && cv::norm(*place) > cv::norm(farthest)) farthest = *place;
  }
  cv::Mat_<double> step;
  cv::multiply(axis.scale, farthest, step, 1.0 / std::sqrt(kRise));
  cv::Mat_<double> out;
  cv::gemm(step, step, 1.0, covariance, 1.0, out, cv::GEMM_2_T);
  return out;
}

}  // namespace calib
