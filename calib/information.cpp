#include "calib/information.h"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numeric>

#include "calib/corner_error.h"

namespace calib {
namespace {

// Normal equations in blocks: shared parameters (intrinsics, then the free offsets), and one pose after the other.
class NormalEquations {
 public:
  explicit NormalEquations(int shared) : shared_(Eigen::MatrixXd::Zero(shared, shared)) { begin_pose(); }

  void begin_pose() {
    pose_ = Eigen::Matrix<double, 6, 6>::Zero();
    cross_ = Eigen::MatrixXd::Zero(shared_.rows(), 6);
  }
  void add(const Eigen::MatrixXd& by_shared, const std::vector<int>& columns,
           const Eigen::Matrix<double, 2, 6>& by_pose) {
    const Eigen::MatrixXd square = by_shared.transpose() * by_shared;
    const Eigen::MatrixXd mixed = by_shared.transpose() * by_pose;
    for (int a = 0; a < square.rows(); ++a) {
      const int row = columns[static_cast<std::size_t>(a)];
      cross_.row(row) += mixed.row(a);
      for (int b = 0; b < square.cols(); ++b) shared_(row, columns[static_cast<std::size_t>(b)]) += square(a, b);
    }
    pose_ += by_pose.transpose() * by_pose;
  }
  // The pose is left free: what the corners said about it is no longer there for the shared parameters.
  void end_pose() { shared_ -= cross_ * pose_.ldlt().solve(cross_.transpose()); }
  void add_diagonal(int column, double value) { shared_(column, column) += value; }
  const Eigen::MatrixXd& shared() const { return shared_; }

 private:
  Eigen::MatrixXd shared_;
  Eigen::Matrix<double, 6, 6> pose_;
  Eigen::MatrixXd cross_;
};

// Columns of a point's free offsets among the shared parameters, and which of its three axes they are.
struct FreeAxes {
  std::vector<int> axes;
  int column_of(std::size_t point, int intrinsics, std::size_t k) const {
    return intrinsics + static_cast<int>(point * axes.size() + k);
  }
};

void add_corner(const Bundle& bundle, std::size_t v, std::size_t i, std::size_t point, const FreeAxes& free,
                NormalEquations& equations) {
  const int count = intrinsics_count(bundle.lens);
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> by_intrinsics(2, count);
  Eigen::Matrix<double, 2, 6, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_offset;
  double residual[2];
  if (!corner_error(bundle.lens, bundle.px[v][i], bundle.intrinsics.data(), bundle.poses[v].data(),
                    bundle.point_on_board(point), residual, {by_intrinsics.data(), by_pose.data(), by_offset.data()})) {
    return;
  }
  const auto axes = static_cast<int>(free.axes.size());
  Eigen::MatrixXd by_shared(2, count + axes);
  by_shared.leftCols(count) = by_intrinsics;
  std::vector<int> columns(static_cast<std::size_t>(count));
  for (int c = 0; c < count; ++c) columns[static_cast<std::size_t>(c)] = c;
  for (int k = 0; k < axes; ++k) {
    by_shared.col(count + k) = by_offset.col(free.axes[static_cast<std::size_t>(k)]);
    columns.push_back(free.column_of(point, count, static_cast<std::size_t>(k)));
  }
  equations.add(by_shared, columns, by_pose);
}

Information invert(const Eigen::MatrixXd& shared, int intrinsics) {
  Information out;
  out.covariance = cv::Mat_<double>(intrinsics, intrinsics, 0.0);
  for (int i = 0; i < intrinsics; ++i) out.covariance(i, i) = std::numeric_limits<double>::infinity();
  // Offsets are left free first; their prior keeps that block regular.
  const Eigen::Index n = intrinsics;
  const Eigen::Index m = shared.rows() - n;
  Eigen::MatrixXd information = shared.topLeftCorner(n, n);
  if (m > 0) {
    information -=
        shared.topRightCorner(n, m) * shared.bottomRightCorner(m, m).ldlt().solve(shared.bottomLeftCorner(m, n));
  }
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (!(scale.minCoeff() > 0.0) || !information.allFinite()) return out;
  const Eigen::VectorXd inverse_scale = scale.cwiseInverse();
  const Eigen::MatrixXd scaled = inverse_scale.asDiagonal() * information * inverse_scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  out.conditioning = std::max(0.0, eigen.eigenvalues()(0)) / eigen.eigenvalues()(n - 1);
  if (out.conditioning < 1e-13) return out;
  const Eigen::MatrixXd inverse =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  for (int r = 0; r < intrinsics; ++r) {
    for (int c = 0; c < intrinsics; ++c) out.covariance(r, c) = inverse(r, c) * inverse_scale(r) * inverse_scale(c);
  }
  return out;
}

}  // namespace

Information intrinsics_information(const Bundle& bundle, double noise_px) {
  FreeAxes free;
  if (bundle.free_layout) free.axes = {0, 1};
  if (bundle.free_flatness) free.axes.push_back(2);
  const int count = intrinsics_count(bundle.lens);
  const int shared = count + static_cast<int>(free.axes.size() * bundle.offsets.size());
  NormalEquations equations(shared);
  for (int c = count; c < shared; ++c) {
    equations.add_diagonal(c, noise_px * noise_px / (bundle.offset_sigma_m * bundle.offset_sigma_m));
  }
  for (std::size_t v = 0; v < bundle.views.size(); ++v) {
    equations.begin_pose();
    bool any = false;
    for (std::size_t i = 0; i < bundle.px[v].size(); ++i) {
      if (!bundle.used[v][i]) continue;
      add_corner(bundle, v, i, static_cast<std::size_t>(bundle.views[v]->points[i]), free, equations);
      any = true;
    }
    if (any) equations.end_pose();
  }
  return invert(equations.shared(), count);
}

cv::Mat_<double> view_information(LensChoice lens, const std::vector<double>& intrinsics,
                                  const PoseNumbers& camera_from_board, const std::vector<cv::Vec3d>& points) {
  const int count = intrinsics_count(lens);
  NormalEquations equations(count);
  std::vector<int> columns(static_cast<std::size_t>(count));
  std::iota(columns.begin(), columns.end(), 0);
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor> by_intrinsics(2, count);
  Eigen::Matrix<double, 2, 6, Eigen::RowMajor> by_pose;
  int seen = 0;
  for (const cv::Vec3d& point : points) {
    double px[2];
    if (!corner_error(lens, {}, intrinsics.data(), camera_from_board.data(), point, px,
                      {by_intrinsics.data(), by_pose.data(), nullptr})) {
      continue;
    }
    equations.add(by_intrinsics, columns, by_pose);
    ++seen;
  }
  cv::Mat_<double> out(count, count, 0.0);
  if (seen < 4) return out;
  equations.end_pose();
  for (int r = 0; r < count; ++r) {
    for (int c = 0; c < count; ++c) out(r, c) = equations.shared()(r, c);
  }
  return out;
}

}  // namespace calib
