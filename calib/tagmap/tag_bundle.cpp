#include "calib/tagmap/tag_bundle.h"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "ar/track/lens.h"
#include "ar/track/tag_map.h"
#include "calib/solve/corner_error.h"
#include "calib/solve/linear.h"

namespace calib {
namespace {

// One corner: the map's point from the tag's pose, then the camera's picture of it.
class TagCornerCost : public ceres::SizedCostFunction<2, 6, 6> {
 public:
  TagCornerCost(LensChoice lens, const double* intrinsics, const cv::Vec3d& in_tag, const cv::Point2d& px)
      : lens_(lens), intrinsics_(intrinsics), in_tag_(in_tag), px_(px) {}

  // Blocks: camera from map, map from tag.
  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override {
    cv::Matx<double, 3, 6> by_tag;
    const cv::Vec3d in_map = transformed(blocks[1], in_tag_, &by_tag);
    cv::Matx23d by_map_point;
    const CornerJacobians wanted{nullptr, jacobians != nullptr ? jacobians[0] : nullptr, by_map_point.val};
    if (!corner_error(lens_, px_, intrinsics_, blocks[0], in_map, residual, wanted)) return false;
    if (jacobians == nullptr || jacobians[1] == nullptr) return true;
    const cv::Matx<double, 2, 6> chained = by_map_point * by_tag;
    std::copy(std::begin(chained.val), std::end(chained.val), jacobians[1]);
    return true;
  }

 private:
  LensChoice lens_;
  const double* intrinsics_;
  cv::Vec3d in_tag_;
  cv::Point2d px_;
};

struct Parameters {
  std::vector<PoseNumbers> cameras;  // camera from map
  std::vector<PoseNumbers> tags;     // map from tag
};

Parameters parameters_of(const TagBundle& bundle) {
  Parameters p;
  for (const ar::Rigid3& pose : bundle.map_from_camera) p.cameras.push_back(numbers_of(pose.inverse()));
  for (const ar::Rigid3& pose : bundle.map_from_tag) p.tags.push_back(numbers_of(pose));
  return p;
}

void fill(const TagBundle& bundle, double robust_scale_px, LensChoice lens, const std::vector<double>& intrinsics,
          Parameters& p, ceres::Problem& problem) {
  for (const TagObservation& seen : bundle.observations) {
    if (!seen.used) continue;
    const auto in_tag = ar::corners_in_tag(bundle.tag_size_m[seen.tag]);
    for (std::size_t i = 0; i < 4; ++i) {
      problem.AddResidualBlock(new TagCornerCost(lens, intrinsics.data(), in_tag[i], seen.px[i]),
                               robust_scale_px > 0.0 ? new ceres::CauchyLoss(robust_scale_px) : nullptr,
                               p.cameras[seen.camera].data(), p.tags[seen.tag].data());
    }
  }
  if (problem.HasParameterBlock(p.tags[0].data())) problem.SetParameterBlockConstant(p.tags[0].data());
}

bool is_finite(const PoseNumbers& pose) {
  for (double v : pose) {
    if (!std::isfinite(v)) return false;
  }
  return true;
}

// d(pixel) by small steps of the camera (along the map's axes) and of the tag, as ar::moved() takes them.
struct Derivatives {
  bool valid = false;
  cv::Matx<double, 2, 6> by_camera;
  cv::Matx<double, 2, 6> by_tag;
};

Derivatives derivatives_of(const ar::Lens& lens, const ar::Rigid3& map_from_camera, const ar::Rigid3& map_from_tag,
                           const cv::Vec3d& in_tag) {
  Derivatives out;
  const cv::Vec3d in_map = map_from_tag * in_tag;
  const cv::Vec3d from_camera = in_map - map_from_camera.translation;
  const cv::Matx33d camera_from_map = map_from_camera.rotation.t();
  cv::Matx23d by_point;
  if (!lens.project(camera_from_map * from_camera, &by_point)) return out;
  out.valid = true;
  const cv::Matx23d by_shift = by_point * camera_from_map;
  // A turn of the tag moves its corner by w x (R x); one of the camera moves the point the other way.
  const cv::Matx23d tag_turn = by_shift * ar::cross_matrix(in_map - map_from_tag.translation) * -1.0;
  const cv::Matx23d camera_turn = by_shift * ar::cross_matrix(from_camera);
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < 3; ++c) {
      out.by_tag(r, c) = tag_turn(r, c);
      out.by_tag(r, c + 3) = by_shift(r, c);
      out.by_camera(r, c) = camera_turn(r, c);
      out.by_camera(r, c + 3) = -by_shift(r, c);
    }
  }
  return out;
}

// Information about all tags' poses, the first one's included, each camera's pose left free.
cv::Mat_<double> tags_information(const TagBundle& bundle) {
  const ar::Lens lens(bundle.lens);
  const int n = static_cast<int>(6 * bundle.map_from_tag.size());
  cv::Mat_<double> information(n, n, 0.0);
  for (std::size_t camera = 0; camera < bundle.map_from_camera.size(); ++camera) {
    cv::Matx66d of_camera = cv::Matx66d::zeros();
    cv::Mat_<double> cross(6, n, 0.0);
    for (const TagObservation& seen : bundle.observations) {
      if (!seen.used || seen.camera != camera) continue;
      const int at = static_cast<int>(6 * seen.tag);
      const cv::Range columns(at, at + 6);
      for (const cv::Vec3d& corner : ar::corners_in_tag(bundle.tag_size_m[seen.tag])) {
        const Derivatives d =
            derivatives_of(lens, bundle.map_from_camera[camera], bundle.map_from_tag[seen.tag], corner);
        if (!d.valid) continue;
        information(columns, columns) += cv::Mat(d.by_tag.t() * d.by_tag);
        cross.colRange(columns) += cv::Mat(d.by_camera.t() * d.by_tag);
        of_camera += d.by_camera.t() * d.by_camera;
      }
    }
    if (cv::trace(of_camera) > 0.0)
      information -= transposed_product(cross, solve_symmetric(cv::Mat(of_camera), cross));
  }
  return information;
}

}  // namespace

bool minimise(TagBundle& bundle, double robust_scale_px) {
  FLAGS_minloglevel = google::GLOG_FATAL;
  const LensChoice lens = lens_choice_of(bundle.lens);
  const std::vector<double> intrinsics = intrinsics_of(lens, bundle.lens);
  Parameters p = parameters_of(bundle);
  ceres::Problem problem;
  fill(bundle, robust_scale_px, lens, intrinsics, p, problem);
  if (problem.NumResidualBlocks() == 0) return false;
  ceres::Solver::Options settings;
  settings.linear_solver_type = ceres::DENSE_SCHUR;
  settings.max_num_iterations = 100;
  settings.function_tolerance = 1e-9;
  settings.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(settings, &problem, &summary);
  if (!summary.IsSolutionUsable()) return false;
  for (std::size_t i = 0; i < p.cameras.size(); ++i) {
    if (!is_finite(p.cameras[i])) return false;
    bundle.map_from_camera[i] = pose_of(p.cameras[i]).inverse();
  }
  for (std::size_t i = 0; i < p.tags.size(); ++i) {
    if (!is_finite(p.tags[i])) return false;
    bundle.map_from_tag[i] = pose_of(p.tags[i]);
  }
  return true;
}

double observation_rms_px(const ar::Lens& lens, const TagBundle& bundle, const TagObservation& seen) {
  const ar::Rigid3 camera_from_tag = bundle.map_from_camera[seen.camera].inverse() * bundle.map_from_tag[seen.tag];
  const auto in_tag = ar::corners_in_tag(bundle.tag_size_m[seen.tag]);
  double sum = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto px = lens.project(camera_from_tag * in_tag[i]);
    if (!px) return std::numeric_limits<double>::infinity();
    const cv::Point2d off = seen.px[i] - *px;
    sum += off.dot(off);
  }
  return std::sqrt(sum / 4.0);
}

std::vector<cv::Matx66d> tag_covariances(const TagBundle& bundle) {
  const cv::Mat_<double> all = tags_information(bundle);
  const int n = all.rows - 6;  // without the first tag's, which stays
  std::vector<cv::Matx66d> covariances(bundle.map_from_tag.size(), cv::Matx66d::zeros());
  if (n == 0) return covariances;
  const cv::Range others(6, all.rows);
  const SymmetricEigen eigen = symmetric_eigen(all(others, others).clone());
  const bool regular = eigen.values(0) > 1e-12 * eigen.values(n - 1);
  for (std::size_t t = 1; t < covariances.size(); ++t) {
    const int at = static_cast<int>(6 * (t - 1));
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < 6; ++c) {
        double sum = regular || r != c ? 0.0 : std::numeric_limits<double>::infinity();
        for (int k = 0; regular && k < n; ++k) {
          sum += eigen.vectors(at + r, k) * eigen.vectors(at + c, k) / eigen.values(k);
        }
        covariances[t](r, c) = sum;
      }
    }
  }
  return covariances;
}

}  // namespace calib
