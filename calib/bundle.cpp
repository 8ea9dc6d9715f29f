#include "calib/bundle.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <memory>

#include "calib/projection.h"

namespace calib {
namespace {

struct CornerError {
  LensChoice lens;
  cv::Point2d px;
  cv::Vec3d on_board;

  template <typename T>
  bool operator()(const T* intrinsics, const T* pose, T* residual) const {
    const T point[3] = {T(on_board[0]), T(on_board[1]), T(on_board[2])};
    return error_at(intrinsics, pose, point, residual);
  }
  template <typename T>
  bool operator()(const T* intrinsics, const T* pose, const T* offset, T* residual) const {
    const T point[3] = {on_board[0] + offset[0], on_board[1] + offset[1], on_board[2] + offset[2]};
    return error_at(intrinsics, pose, point, residual);
  }
  template <typename T>
  bool error_at(const T* intrinsics, const T* pose, const T* point, T* residual) const {
    if (!project_board_point(lens, intrinsics, pose, point, residual)) return false;
    residual[0] -= px.x;
    residual[1] -= px.y;
    return true;
  }
};

// What is known of a point's place on the board, in units of the corners' noise.
struct OffsetPrior {
  double weight;
  template <typename T>
  bool operator()(const T* offset, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = weight * offset[i];
    return true;
  }
};

template <int N>
std::unique_ptr<ceres::CostFunction> cost_of_size(const CornerError& error, bool with_offset) {
  if (with_offset)
    return std::make_unique<ceres::AutoDiffCostFunction<CornerError, 2, N, 6, 3>>(new CornerError(error));
  return std::make_unique<ceres::AutoDiffCostFunction<CornerError, 2, N, 6>>(new CornerError(error));
}

std::unique_ptr<ceres::CostFunction> cost_of(const CornerError& error, bool with_offset) {
  switch (intrinsics_count(error.lens)) {
    case 4:
      return cost_of_size<4>(error, with_offset);
    case 6:
      return cost_of_size<6>(error, with_offset);
    case 8:
      return cost_of_size<8>(error, with_offset);
    case 9:
      return cost_of_size<9>(error, with_offset);
    default:
      return cost_of_size<12>(error, with_offset);
  }
}

CornerError corner_error(const Bundle& bundle, std::size_t view, std::size_t i) {
  const auto point = static_cast<std::size_t>(bundle.views[view]->points[i]);
  return {bundle.lens, bundle.px[view][i], bundle.board->points[point]};
}

// Calls with each used corner: view, index within it, index of its point on the board.
template <typename Visit>
void for_each_corner(const Bundle& bundle, const Visit& visit) {
  for (std::size_t v = 0; v < bundle.views.size(); ++v) {
    for (std::size_t i = 0; i < bundle.px[v].size(); ++i) {
      if (bundle.used[v][i]) visit(v, i, static_cast<std::size_t>(bundle.views[v]->points[i]));
    }
  }
}

void hold_offset_axes(const Bundle& bundle, ceres::Problem& problem, double* offset) {
  if (!bundle.free_flatness) problem.SetManifold(offset, new ceres::SubsetManifold(3, {2}));
  if (!bundle.free_layout) problem.SetManifold(offset, new ceres::SubsetManifold(3, {0, 1}));
}

void hold_intrinsics(const MinimiseOptions& options, Bundle& bundle, ceres::Problem& problem) {
  double* intrinsics = bundle.intrinsics.data();
  if (!problem.HasParameterBlock(intrinsics)) return;
  if (options.hold_intrinsics) {
    problem.SetParameterBlockConstant(intrinsics);
  } else if (options.hold_distortion) {
    std::vector<int> held;
    for (int i = 2; i < intrinsics_count(bundle.lens); ++i) held.push_back(i);
    problem.SetManifold(intrinsics, new ceres::SubsetManifold(intrinsics_count(bundle.lens), held));
  }
}

void fill(Bundle& bundle, const MinimiseOptions& options, ceres::Problem& problem) {
  const bool with_offset = bundle.frees_offsets();
  const auto loss = [&]() -> ceres::LossFunction* {
    return options.robust_scale_px > 0.0 ? new ceres::CauchyLoss(options.robust_scale_px) : nullptr;
  };
  for_each_corner(bundle, [&](std::size_t v, std::size_t i, std::size_t point) {
    std::vector<double*> blocks{bundle.intrinsics.data(), bundle.poses[v].data()};
    if (with_offset) blocks.push_back(bundle.offsets[point].data());
    problem.AddResidualBlock(cost_of(corner_error(bundle, v, i), with_offset).release(), loss(), blocks);
  });
  hold_intrinsics(options, bundle, problem);
  if (!with_offset) return;
  for (auto& offset : bundle.offsets) {
    if (!problem.HasParameterBlock(offset.data())) continue;
    const double weight = options.noise_px / bundle.offset_sigma_m;
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<OffsetPrior, 3, 3>(new OffsetPrior{weight}), nullptr,
                             offset.data());
    hold_offset_axes(bundle, problem, offset.data());
  }
}

// Poses are eliminated first: each touches its own corners only.
std::shared_ptr<ceres::ParameterBlockOrdering> poses_first(Bundle& bundle, const ceres::Problem& problem) {
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (auto& pose : bundle.poses) {
    if (problem.HasParameterBlock(pose.data())) ordering->AddElementToGroup(pose.data(), 0);
  }
  if (problem.HasParameterBlock(bundle.intrinsics.data())) ordering->AddElementToGroup(bundle.intrinsics.data(), 1);
  for (auto& offset : bundle.offsets) {
    if (problem.HasParameterBlock(offset.data())) ordering->AddElementToGroup(offset.data(), 1);
  }
  return ordering;
}

bool is_finite(const Bundle& bundle) {
  for (double v : bundle.intrinsics) {
    if (!std::isfinite(v)) return false;
  }
  for (const auto& pose : bundle.poses) {
    for (double v : pose) {
      if (!std::isfinite(v)) return false;
    }
  }
  return bundle.intrinsics[0] > 0.0 && bundle.intrinsics[1] > 0.0;
}

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
  const double* blocks[] = {bundle.intrinsics.data(), bundle.poses[v].data(), bundle.offsets[point].data()};
  double* jacobians[] = {by_intrinsics.data(), by_pose.data(), by_offset.data()};
  double residual[2];
  if (!cost_of(corner_error(bundle, v, i), true)->Evaluate(blocks, residual, jacobians)) return;
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

bool minimise(Bundle& bundle, const MinimiseOptions& options) {
  FLAGS_minloglevel = google::GLOG_FATAL;  // a step that fails is answered here, not told on standard error
  ceres::Problem problem;
  fill(bundle, options, problem);
  if (problem.NumResidualBlocks() == 0) return false;
  ceres::Solver::Options settings;
  settings.linear_solver_type =
      options.hold_intrinsics && !bundle.frees_offsets() ? ceres::DENSE_QR : ceres::DENSE_SCHUR;
  if (settings.linear_solver_type == ceres::DENSE_SCHUR) settings.linear_solver_ordering = poses_first(bundle, problem);
  settings.max_num_iterations = 200;
  settings.function_tolerance = options.tolerance;
  settings.gradient_tolerance = 1e-12;
  settings.parameter_tolerance = 1e-10;
  settings.logging_type = ceres::SILENT;
  settings.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(settings, &problem, &summary);
  return summary.IsSolutionUsable() && is_finite(bundle);
}

std::vector<cv::Point2d> residuals(const Bundle& bundle, std::size_t view) {
  std::vector<cv::Point2d> out;
  for (std::size_t i = 0; i < bundle.px[view].size(); ++i) {
    const auto point = static_cast<std::size_t>(bundle.views[view]->points[i]);
    double r[2];
    const bool fine = corner_error(bundle, view, i)(bundle.intrinsics.data(), bundle.poses[view].data(),
                                                    bundle.offsets[point].data(), r);
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    out.emplace_back(fine ? -r[0] : nowhere, fine ? -r[1] : nowhere);
  }
  return out;
}

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

}  // namespace calib
