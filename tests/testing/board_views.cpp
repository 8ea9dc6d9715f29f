#include "tests/testing/board_views.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "ar/track/lens.h"

namespace calib::testing {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// The middle of the board on the ray of a pixel, turned by a tilt towards any side and about its normal.
ar::Rigid3 some_pose(const Board& board, const ar::CameraModel& camera, const ar::Lens& lens, double most_tilt,
                     Random& random) {
  const cv::Point2d px(uniform(random, 0.05, 0.95) * camera.width, uniform(random, 0.05, 0.95) * camera.height);
  const auto ideal = lens.ideal_from_pixel(px);
  if (!ideal) return {};
  const double towards = uniform(random, 0.0, 2.0 * std::numbers::pi);
  const double tilt = uniform(random, 0.0, most_tilt);
  const cv::Matx33d rotation = ar::rotation_from_vector({tilt * std::cos(towards), tilt * std::sin(towards), 0.0}) *
                               ar::rotation_from_vector({0.0, 0.0, uniform(random, -0.5, 0.5)});
  const cv::Vec3d ray = cv::normalize(cv::Vec3d(ideal->x, ideal->y, 1.0));
  cv::Vec3d middle(0.0, 0.0, 0.0);
  for (const cv::Vec3d& p : board.points) middle += p / static_cast<double>(board.points.size());
  // A board as large as a third to two thirds of the picture's longer side.
  const double share = uniform(random, 0.3, 0.65);
  const double distance = board.diagonal_m() * camera.intrinsics(0, 0) / (share * camera.width);
  return {rotation, distance * ray - rotation * middle};
}

std::optional<Observation> whole_view(const Board& board, const ar::CameraModel& camera, const ar::Lens& lens,
                                      const ar::Rigid3& camera_from_board) {
  Observation view;
  view.edge_width_px = 2.0;
  for (std::size_t i = 0; i < board.points.size(); ++i) {
    const auto px = lens.project(camera_from_board * board.points[i]);
    if (!px || px->x < 0.0 || px->y < 0.0 || px->x > camera.width - 1.0 || px->y > camera.height - 1.0)
      return std::nullopt;
    view.points.push_back(static_cast<int>(i));
    view.px.push_back(*px);
  }
  return view;
}

}  // namespace

ar::CameraModel true_camera(LensChoice lens) {
  std::vector<double> v{1000.0, 1004.0, 652.0, 471.0};
  switch (lens) {
    case LensChoice::Pinhole:
      break;
    case LensChoice::PlumbBob2:
      v.insert(v.end(), {-0.21, 0.06});
      break;
    case LensChoice::PlumbBob4:
      v.insert(v.end(), {-0.21, 0.06, 0.0008, -0.0006});
      break;
    case LensChoice::PlumbBob5:
      v.insert(v.end(), {-0.24, 0.1, 0.0008, -0.0006, -0.03});
      break;
    case LensChoice::Rational8:
      // A wide lens: only strong distortion tells numerator and denominator apart.
      v = {620.0, 622.0, 648.0, 474.0, 0.35, 0.05, 0.0006, -0.0004, 0.004, 0.72, 0.18, 0.02};
      break;
    case LensChoice::Fisheye4:
      v = {470.0, 472.0, 648.0, 474.0, 0.05, -0.02, 0.012, -0.003};
      break;
  }
  return camera_of(lens, v, 1280, 960);
}

Observations see(const Board& board, const ar::CameraModel& camera, const ViewSet& set) {
  const ar::Lens lens(camera);
  Observations out;
  out.width = camera.width;
  out.height = camera.height;
  Random random(set.poses_seed);
  for (int tries = 0; static_cast<int>(out.views.size()) < set.views && tries < 100000; ++tries) {
    auto view = whole_view(board, camera, lens, some_pose(board, camera, lens, set.most_tilt_rad, random));
    if (view) out.views.push_back(std::move(*view));
  }
  Random noise(set.noise_seed);
  std::normal_distribution<double> normal(0.0, set.noise_px);
  for (std::size_t v = 0; v < out.views.size(); ++v) {
    out.views[v].name = fmt::format("view {}", v);
    if (set.noise_px == 0.0) continue;
    for (cv::Point2d& p : out.views[v].px) p += cv::Point2d(normal(noise), normal(noise));
  }
  return out;
}

}  // namespace calib::testing
