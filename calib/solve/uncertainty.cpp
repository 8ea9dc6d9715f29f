#include "calib/solve/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "ar/track/lens.h"
#include "calib/solve/projection.h"
#include "render/base/check.h"

namespace calib {
namespace {

const cv::Point2d kNowhere(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN());

bool is_nowhere(const cv::Point2d& p) {
  return !std::isfinite(p.x);
}

// The cells that decide about the rotation: those with corners; all where hardly any have.
std::vector<bool> deciding_cells(const std::vector<int>& corners) {
  std::vector<bool> decides;
  for (int count : corners) decides.push_back(count > 0);
  if (std::count(decides.begin(), decides.end(), true) < 4) decides.assign(corners.size(), true);
  return decides;
}

// d(pixel) / d(small rotation of the ray) and d(pixel) / d(intrinsics).
struct CellDerivatives {
  bool valid = false;
  cv::Matx23d by_rotation;
  cv::Mat_<double> by_intrinsics;  // 2 x n
};

cv::Matx23d by_rotation(const ar::Lens& lens, const cv::Point2d& ideal) {
  cv::Matx23d by_point = cv::Matx23d::zeros();
  const cv::Vec3d ray(ideal.x, ideal.y, 1.0);
  lens.project(ray, &by_point);
  return by_point * ar::cross_matrix(ray) * -1.0;  // d(R ray) = w x ray = -[ray]x w
}

CellDerivatives derivatives_at(const LensNumbers& numbers, const ar::Lens& lens, const cv::Point2d& px) {
  CellDerivatives out;
  const auto ideal = lens.ideal_from_pixel(px);
  if (!ideal) return out;
  out.valid = true;
  out.by_rotation = by_rotation(lens, *ideal);
  out.by_intrinsics.create(2, static_cast<int>(numbers.intrinsics.size()));
  const double point[3] = {ideal->x, ideal->y, 1.0};
  double pixel[2];
  project_point(numbers.lens, numbers.intrinsics.data(), point, pixel, out.by_intrinsics.ptr<double>());
  return out;
}

cv::Mat_<double> product(const cv::Mat& a, const cv::Mat& b, int transposed = 0) {
  cv::Mat_<double> out;
  cv::gemm(a, b, 1.0, cv::noArray(), 0.0, out, transposed);
  return out;
}

double largest_sigma(const cv::Matx22d& covariance) {
  const double mean = 0.5 * (covariance(0, 0) + covariance(1, 1));
  const double half = 0.5 * (covariance(0, 0) - covariance(1, 1));
  return std::sqrt(std::max(0.0, mean + std::hypot(half, covariance(0, 1))));
}

// Of each cell: how the intrinsics move what is seen there, 2 x n, each change taken with the rotation that hides it
// best; nothing where the lens has no inverse.
std::vector<std::optional<cv::Mat_<double>>> seen_by_intrinsics(const LensNumbers& numbers, const Grid& grid,
                                                                const std::vector<int>& corners) {
  const ar::Lens lens(camera_of(numbers.lens, numbers.intrinsics, grid.width, grid.height));
  const std::vector<bool> decides = deciding_cells(corners);
  std::vector<CellDerivatives> cells;
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Mat_<double> mixed(3, static_cast<int>(numbers.intrinsics.size()), 0.0);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    cells.push_back(derivatives_at(numbers, lens, grid.middle(i)));
    const CellDerivatives& cell = cells.back();
    if (!cell.valid || !decides[i]) continue;
    normal += cell.by_rotation.t() * cell.by_rotation;
    mixed += product(cv::Mat(cell.by_rotation), cell.by_intrinsics, cv::GEMM_1_T);
  }
  cv::Mat_<double> hiding;  // 3 x n: minus the rotation that hides a change of the intrinsics best
  cv::solve(cv::Mat(normal), mixed, hiding, cv::DECOMP_SVD);
  std::vector<std::optional<cv::Mat_<double>>> seen;
  for (const CellDerivatives& cell : cells) {
    seen.emplace_back();
    if (!cell.valid) continue;
    cv::Mat_<double> rest;
    cv::subtract(cell.by_intrinsics, product(cv::Mat(cell.by_rotation), hiding), rest);
    seen.back() = rest;
  }
  return seen;
}

}  // namespace

cv::Point2d Grid::middle(std::size_t cell) const {
  const std::size_t column = cell % static_cast<std::size_t>(columns);
  const std::size_t row = cell / static_cast<std::size_t>(columns);
  return {(static_cast<double>(column) + 0.5) * width / columns - 0.5,
          (static_cast<double>(row) + 0.5) * height / rows - 0.5};
}

std::size_t Grid::cell_of(const cv::Point2d& px) const {
  const int column = std::clamp(static_cast<int>(std::floor((px.x + 0.5) * columns / width)), 0, columns - 1);
  const int row = std::clamp(static_cast<int>(std::floor((px.y + 0.5) * rows / height)), 0, rows - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
}

Grid make_grid(int width, int height, int across) {
  CHECK(std::min(width, height) > 0);
  CHECK(across > 0);
  const double cell = static_cast<double>(std::max(width, height)) / across;
  const auto count = [&](int side) { return std::max(1, static_cast<int>(std::lround(side / cell))); };
  return {count(width), count(height), width, height};
}

std::vector<int> corners_in_cells(const Observations& observations, const Solution& solution, const Grid& grid) {
  std::vector<int> count(grid.size(), 0);
  for (std::size_t v = 0; v < observations.views.size(); ++v) {
    for (std::size_t i = 0; i < observations.views[v].px.size(); ++i) {
      if (solution.views[v].used[i]) ++count[grid.cell_of(observations.views[v].px[i])];
    }
  }
  return count;
}

std::vector<double> projected_sigma_px(const Solution& solution, const Grid& grid, const std::vector<int>& corners) {
  std::vector<double> sigma;
  for (const auto& seen : seen_by_intrinsics({solution.lens, solution.intrinsics}, grid, corners)) {
    if (!seen) {
      sigma.push_back(std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const cv::Mat_<double> covariance = product(product(*seen, solution.local_covariance), *seen, cv::GEMM_2_T);
    const double value = largest_sigma(cv::Matx22d(covariance));
    sigma.push_back(std::isfinite(value) ? value : std::numeric_limits<double>::infinity());
  }
  return sigma;
}

cv::Mat_<double> direction_moments(const LensNumbers& numbers, const Grid& grid) {
  const int n = static_cast<int>(numbers.intrinsics.size());
  cv::Mat_<double> moments(n, n, 0.0);
  for (const auto& seen : seen_by_intrinsics(numbers, grid, std::vector<int>(grid.size(), 1))) {
    if (seen) moments += product(*seen, *seen, cv::GEMM_1_T) / static_cast<double>(grid.size());
  }
  return moments;
}

std::vector<cv::Point2d> difference_px(const ar::CameraModel& one, const ar::CameraModel& other, const Grid& grid,
                                       const std::vector<int>& corners) {
  const ar::Lens first(one);
  const ar::Lens second(other);
  const std::vector<bool> decides = deciding_cells(corners);
  cv::Matx33d rotation = cv::Matx33d::eye();
  std::vector<cv::Point2d> off(grid.size(), kNowhere);
  for (int round = 0; round < 5; ++round) {
    cv::Matx33d normal = cv::Matx33d::zeros();
    cv::Vec3d gradient(0.0, 0.0, 0.0);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const cv::Point2d px = grid.middle(i);
      const auto ideal = first.ideal_from_pixel(px);
      if (!ideal) continue;
      const cv::Vec3d ray = rotation * cv::Vec3d(ideal->x, ideal->y, 1.0);
      const auto seen = second.project(ray);
      off[i] = seen ? *seen - px : kNowhere;
      if (!seen || !decides[i]) continue;
      const cv::Matx23d jacobian = by_rotation(second, {ray[0] / ray[2], ray[1] / ray[2]});
      normal += jacobian.t() * jacobian;
      gradient += jacobian.t() * cv::Vec2d(off[i].x, off[i].y);
    }
    cv::Vec3d step;
    if (!cv::solve(normal, -gradient, step, cv::DECOMP_CHOLESKY)) break;
    rotation = ar::rotation_from_vector(step) * rotation;
  }
  std::replace_if(off.begin(), off.end(), is_nowhere, kNowhere);
  return off;
}

}  // namespace calib
