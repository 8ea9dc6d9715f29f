#include "calib/weak_direction.h"

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <vector>

#include "calib/projection.h"

namespace calib {
namespace {

constexpr double kRise = 9.0;       // of the sum of squares, in variances: three standard deviations
constexpr double kFarthest = 64.0;  // in linear reaches
constexpr double kStraightEnough = 1.05;

// The corners' places as functions of the intrinsics alone, the poses' first-order effect projected out.
class CornerField {
 public:
  explicit CornerField(const Bundle& bundle) : bundle_(bundle), n_(static_cast<int>(bundle.intrinsics.size())) {
    for (std::size_t v = 0; v < bundle.views.size(); ++v) add_view(v);
    reference_ = evaluate(Eigen::Map<const Eigen::VectorXd>(bundle.intrinsics.data(), n_), nullptr);
  }

  // Change of all corners against the solution; by_intrinsics receives its derivatives.
  Eigen::VectorXd change(const Eigen::VectorXd& intrinsics, Eigen::MatrixXd* by_intrinsics) const {
    Eigen::VectorXd moved = evaluate(intrinsics, by_intrinsics) - reference_;
    Eigen::Index row = 0;
    for (const View& view : views_) {
      const auto rows = static_cast<Eigen::Index>(2 * view.points.size());
      moved.segment(row, rows) -= view.poses * (view.poses.transpose() * moved.segment(row, rows));
      if (by_intrinsics != nullptr) {
        by_intrinsics->middleRows(row, rows) -=
            view.poses * (view.poses.transpose() * by_intrinsics->middleRows(row, rows));
      }
      row += rows;
    }
    return moved;
  }
  bool empty() const { return views_.empty(); }

 private:
  struct View {
    std::vector<cv::Vec3d> points;  // in the camera's frame
    Eigen::MatrixXd poses;          // orthonormal basis of what a change of the pose does to the corners
  };

  void add_view(std::size_t v) {
    View view;
    std::vector<Eigen::Matrix<double, 2, 6>> by_pose;
    const auto& pose = bundle_.poses[v];
    for (std::size_t i = 0; i < bundle_.px[v].size(); ++i) {
      if (!bundle_.used[v][i]) continue;
      const auto point = static_cast<std::size_t>(bundle_.views[v]->points[i]);
      cv::Matx<double, 3, 6> point_by_pose;
      view.points.push_back(transformed(pose.data(), bundle_.point_on_board(point), &point_by_pose));
      by_pose.push_back(pose_derivative(view.points.back(), point_by_pose));
    }
    if (view.points.size() < 4) return;
    Eigen::MatrixXd stacked(2 * static_cast<Eigen::Index>(by_pose.size()), 6);
    for (std::size_t i = 0; i < by_pose.size(); ++i)
      stacked.middleRows<2>(2 * static_cast<Eigen::Index>(i)) = by_pose[i];
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stacked);
    view.poses = qr.householderQ() * Eigen::MatrixXd::Identity(stacked.rows(), 6);
    views_.push_back(std::move(view));
  }

  Eigen::Matrix<double, 2, 6> pose_derivative(const cv::Vec3d& point, const cv::Matx<double, 3, 6>& by_pose) const {
    double px[2];
    cv::Matx23d by_point;
    cv::Matx<double, 2, 6> out;
    if (project_point(bundle_.lens, bundle_.intrinsics.data(), point.val, px, nullptr, by_point.val)) {
      out = by_point * by_pose;
    }
    return Eigen::Map<const Eigen::Matrix<double, 2, 6, Eigen::RowMajor>>(out.val);
  }

  Eigen::VectorXd evaluate(const Eigen::VectorXd& intrinsics, Eigen::MatrixXd* by_intrinsics) const {
    Eigen::Index rows = 0;
    for (const View& view : views_) rows += static_cast<Eigen::Index>(2 * view.points.size());
    Eigen::VectorXd out(rows);
    if (by_intrinsics != nullptr) by_intrinsics->resize(rows, n_);
    Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> derivatives(2, n_);
    Eigen::Index row = 0;
    for (const View& view : views_) {
      for (const cv::Vec3d& point : view.points) {
        project_point(bundle_.lens, intrinsics.data(), point.val, out.data() + row,
                      by_intrinsics != nullptr ? derivatives.data() : nullptr);
        if (by_intrinsics != nullptr) by_intrinsics->middleRows(row, 2) = derivatives;
        row += 2;
      }
    }
    return out;
  }

  const Bundle& bundle_;
  int n_;
  std::vector<View> views_;
  Eigen::VectorXd reference_;
};

// Scaled coordinates y of the intrinsics, theta = solution + scale * y, and the weakest direction in them.
struct WeakAxis {
  Eigen::VectorXd solution;
  Eigen::VectorXd scale;
  Eigen::VectorXd direction;  // unit
  Eigen::MatrixXd others;     // its orthogonal complement
  double sigma = 0.0;         // linear standard deviation along it
};

WeakAxis weakest(const Bundle& bundle, const Eigen::MatrixXd& covariance) {
  WeakAxis axis;
  axis.solution = Eigen::Map<const Eigen::VectorXd>(bundle.intrinsics.data(), covariance.rows());
  axis.scale = covariance.diagonal().cwiseSqrt();
  const Eigen::VectorXd inverse = axis.scale.cwiseInverse();
  const Eigen::MatrixXd correlation = inverse.asDiagonal() * covariance * inverse.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(correlation);
  const Eigen::Index n = covariance.rows();
  axis.direction = eigen.eigenvectors().col(n - 1);
  axis.others = eigen.eigenvectors().leftCols(n - 1);
  axis.sigma = std::sqrt(eigen.eigenvalues()(n - 1));
  return axis;
}

// Smallest sum of squares, px2, with the coordinate along the axis held at t; `y` is the start and receives the place.
double held_at(const CornerField& field, const WeakAxis& axis, double t, Eigen::VectorXd& y) {
  y += (t - axis.direction.dot(y)) * axis.direction;
  double squares = 0.0;
  for (int iteration = 0; iteration < 8; ++iteration) {
    Eigen::MatrixXd by_intrinsics;
    const Eigen::VectorXd moved = field.change(axis.solution + axis.scale.cwiseProduct(y), &by_intrinsics);
    const double before = squares;
    squares = moved.squaredNorm();
    if (!std::isfinite(squares)) return std::numeric_limits<double>::infinity();
    if (iteration > 1 && std::abs(before - squares) <= 1e-3 * squares) break;
    const Eigen::MatrixXd jacobian = by_intrinsics * axis.scale.asDiagonal() * axis.others;
    y -= axis.others * (jacobian.transpose() * jacobian).ldlt().solve(jacobian.transpose() * moved);
  }
  return squares;
}

// The place towards `side` where the sum of squares has risen by kRise variances; nothing where it rises as fast as
// the derivatives say.
std::optional<Eigen::VectorXd> reach(const CornerField& field, const WeakAxis& axis, double side, double variance) {
  const double linear = std::sqrt(kRise) * axis.sigma;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(axis.direction.size());
  double inside = 0.0;
  double outside = linear * kStraightEnough;
  Eigen::VectorXd inside_y = y;
  while (held_at(field, axis, side * outside, y) < kRise * variance) {
    inside = outside;
    inside_y = y;
    outside *= 1.6;
    if (outside > kFarthest * linear) return inside_y;
  }
  if (inside == 0.0) return std::nullopt;
  for (int halving = 0; halving < 4; ++halving) {
    const double middle = 0.5 * (inside + outside);
    y = inside_y;
    if (held_at(field, axis, side * middle, y) < kRise * variance) {
      inside = middle;
      inside_y = y;
    } else {
      outside = middle;
    }
  }
  return inside_y;
}

}  // namespace

cv::Mat_<double> widened_along_weakest(const Bundle& bundle, const cv::Mat_<double>& covariance, double sigma_px) {
  const auto n = static_cast<Eigen::Index>(bundle.intrinsics.size());
  Eigen::MatrixXd c(n, n);
  for (int r = 0; r < covariance.rows; ++r) {
    for (int k = 0; k < covariance.cols; ++k) c(r, k) = covariance(r, k);
  }
  const CornerField field(bundle);
  if (field.empty() || !c.allFinite() || !(c.diagonal().minCoeff() > 0.0)) return covariance;
  const WeakAxis axis = weakest(bundle, c);
  Eigen::VectorXd farthest = Eigen::VectorXd::Zero(n);
  for (double side : {-1.0, 1.0}) {
    const auto place = reach(field, axis, side, sigma_px * sigma_px);
    if (place && place->norm() > farthest.norm()) farthest = *place;
  }
  const Eigen::VectorXd step = axis.scale.cwiseProduct(farthest) / std::sqrt(kRise);
  cv::Mat_<double> out = covariance.clone();
  for (int r = 0; r < out.rows; ++r) {
    for (int k = 0; k < out.cols; ++k) out(r, k) += step(r) * step(k);
  }
  return out;
}

}  // namespace calib
