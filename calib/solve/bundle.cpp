#include "calib/solve/bundle.h"

#include <ceres/cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/normal_prior.h>
#include <ceres/ordered_groups.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <cmath>
#include <limits>
#include <memory>

#include "calib/solve/corner_error.h"

namespace calib {
namespace {

// Measured less predicted, with the sign turned: what the solver makes small.
class CornerCost : public ceres::CostFunction {
 public:
  CornerCost(LensChoice lens, const cv::Point2d& px, const cv::Vec3d& on_board, bool with_offset)
      : lens_(lens), px_(px), on_board_(on_board) {
    set_num_residuals(2);
    *mutable_parameter_block_sizes() = {intrinsics_count(lens), 6};
    if (with_offset) mutable_parameter_block_sizes()->push_back(3);
  }

  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override {
    const bool with_offset = parameter_block_sizes().size() > 2;
    const cv::Vec3d offset = with_offset ? cv::Vec3d(blocks[2]) : cv::Vec3d();
    const auto wanted = [&](std::size_t i) { return jacobians != nullptr ? jacobians[i] : nullptr; };
    return corner_error(lens_, px_, blocks[0], blocks[1], on_board_ + offset, residual,
                        {wanted(0), wanted(1), with_offset ? wanted(2) : nullptr});
  }

 private:
  LensChoice lens_;
  cv::Point2d px_;
  cv::Vec3d on_board_;
};

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
    problem.AddResidualBlock(new CornerCost(bundle.lens, bundle.px[v][i], bundle.board->points[point], with_offset),
                             loss(), blocks);
  });
  hold_intrinsics(options, bundle, problem);
  if (!with_offset) return;
  for (auto& offset : bundle.offsets) {
    if (!problem.HasParameterBlock(offset.data())) continue;
    // What is known of a point's place on the board, in units of the corners' noise.
    const ceres::Matrix weight = ceres::Matrix::Identity(3, 3) * (options.noise_px / bundle.offset_sigma_m);
    problem.AddResidualBlock(new ceres::NormalPrior(weight, ceres::Vector::Zero(3)), nullptr, offset.data());
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
    const bool fine = corner_error(bundle.lens, bundle.px[view][i], bundle.intrinsics.data(), bundle.poses[view].data(),
                                   bundle.point_on_board(point), r, {});
    const double nowhere = std::numeric_limits<double>::quiet_NaN();
    out.emplace_back(fine ? -r[0] : nowhere, fine ? -r[1] : nowhere);
  }
  return out;
}

}  // namespace calib
