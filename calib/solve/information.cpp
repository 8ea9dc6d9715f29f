#include "calib/solve/information.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "calib/solve/corner_error.h"
#include "calib/solve/linear.h"
#include "render/base/check.h"

namespace calib {
namespace {

constexpr std::size_t kMostColumns = 15;  // of one corner: intrinsics and its offset

// A corner's derivatives, its two coordinates apart.
struct CornerDerivatives {
  struct Rows {
    std::array<double, kMostColumns> u{};
    std::array<double, kMostColumns> v{};
    double dot(std::size_t a, std::size_t b) const { return u[a] * u[b] + v[a] * v[b]; }
  };
  Rows by_shared;
  std::array<double, 12> by_pose{};  // row by row
};

// Normal equations in blocks: shared parameters (intrinsics, then the free offsets), and one pose after the other.
class NormalEquations {
 public:
  explicit NormalEquations(int shared) : shared_(shared, shared, 0.0) { begin_pose(); }

  void begin_pose() {
    pose_ = cv::Mat_<double>(6, 6, 0.0);
    cross_ = cv::Mat_<double>(shared_.rows, 6, 0.0);
  }
  // Derivatives of a corner's two coordinates: by shared parameters, which have those columns, and by the pose.
  void add(const CornerDerivatives& corner, const std::vector<int>& columns) {
    for (std::size_t a = 0; a < columns.size(); ++a) {
      double* shared = shared_[columns[a]];
      double* cross = cross_[columns[a]];
      for (std::size_t b = 0; b < columns.size(); ++b) shared[columns[b]] += corner.by_shared.dot(a, b);
      for (std::size_t p = 0; p < 6; ++p) {
        cross[p] += corner.by_shared.u[a] * corner.by_pose[p] + corner.by_shared.v[a] * corner.by_pose[6 + p];
      }
    }
    for (std::size_t p = 0; p < 6; ++p) {
      for (std::size_t q = 0; q < 6; ++q) {
        pose_(static_cast<int>(p), static_cast<int>(q)) +=
            corner.by_pose[p] * corner.by_pose[q] + corner.by_pose[6 + p] * corner.by_pose[6 + q];
      }
    }
  }
  // The pose is left free: what the corners said about it is no longer there for the shared parameters.
  void end_pose() {
    cv::Mat_<double> mixed;
    cv::transpose(cross_, mixed);
    cv::gemm(cross_, solve_symmetric(pose_, mixed), -1.0, shared_, 1.0, shared_);
  }
  void add_diagonal(int column, double value) { shared_(column, column) += value; }
  const cv::Mat_<double>& shared() const { return shared_; }

 private:
  cv::Mat_<double> shared_;
  cv::Mat_<double> pose_;
  cv::Mat_<double> cross_;
};

// Columns of a point's free offsets among the shared parameters, and which of its three axes they are.
struct FreeAxes {
  std::vector<int> axes;
  int column_of(std::size_t point, int intrinsics, std::size_t k) const {
    return intrinsics + static_cast<int>(point * axes.size() + k);
  }
};

bool differentiate(LensChoice lens, const std::vector<double>& intrinsics, const PoseNumbers& pose,
                   const cv::Vec3d& on_board, CornerDerivatives& corner, double* by_point) {
  std::array<double, 24> by_intrinsics{};
  double px[2];
  if (!corner_error(lens, {}, intrinsics.data(), pose.data(), on_board, px,
                    {by_intrinsics.data(), corner.by_pose.data(), by_point})) {
    return false;
  }
  const auto count = static_cast<std::size_t>(intrinsics_count(lens));
  for (std::size_t i = 0; i < count; ++i) {
    corner.by_shared.u.at(i) = by_intrinsics.at(i);
    corner.by_shared.v.at(i) = by_intrinsics.at(count + i);
  }
  return true;
}

void add_corner(const Bundle& bundle, std::size_t v, std::size_t point, const FreeAxes& free,
                NormalEquations& equations) {
  CornerDerivatives corner;
  std::array<double, 6> by_offset{};
  if (!differentiate(bundle.lens, bundle.intrinsics, bundle.poses[v], bundle.point_on_board(point), corner,
                     by_offset.data())) {
    return;
  }
  const auto count = static_cast<std::size_t>(intrinsics_count(bundle.lens));
  std::vector<int> columns(count);
  std::iota(columns.begin(), columns.end(), 0);
  for (std::size_t k = 0; k < free.axes.size(); ++k) {
    const auto axis = static_cast<std::size_t>(free.axes[k]);
    corner.by_shared.u.at(count + k) = by_offset.at(axis);
    corner.by_shared.v.at(count + k) = by_offset.at(3 + axis);
    columns.push_back(free.column_of(point, static_cast<int>(count), k));
  }
  equations.add(corner, columns);
}

Information invert(const cv::Mat_<double>& shared, int n) {
  Information out;
  out.covariance = cv::Mat_<double>(n, n, 0.0);
  for (int i = 0; i < n; ++i) out.covariance(i, i) = std::numeric_limits<double>::infinity();
  // Offsets are left free first; their prior keeps that block regular.
  cv::Mat_<double> information = shared(cv::Range(0, n), cv::Range(0, n)).clone();
  const cv::Range rest(n, shared.rows);
  if (!rest.empty()) {
    const cv::Mat_<double> mixed = shared(rest, cv::Range(0, n));
    information -= transposed_product(mixed, solve_symmetric(shared(rest, rest), mixed));
  }
  if (!all_finite(information)) return out;
  std::vector<double> scale;
  for (int i = 0; i < n; ++i) {
    if (!(information(i, i) > 0.0)) return out;
    scale.push_back(1.0 / std::sqrt(information(i, i)));
  }
  const auto scale_of = [&](int r, int c) {
    return scale[static_cast<std::size_t>(r)] * scale[static_cast<std::size_t>(c)];
  };
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) information(r, c) *= scale_of(r, c);
  }
  const SymmetricEigen eigen = symmetric_eigen(information);
  out.conditioning = std::max(0.0, eigen.values(0)) / eigen.values(n - 1);
  if (out.conditioning < 1e-13) return out;
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) {
      double sum = 0.0;
      for (int k = 0; k < n; ++k) sum += eigen.vectors(r, k) * eigen.vectors(c, k) / eigen.values(k);
      out.covariance(r, c) = sum * scale_of(r, c);
    }
  }
  return out;
}

}  // namespace

Information intrinsics_information(const Bundle& bundle, double noise_px) {
  CHECK(noise_px > 0.0);
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
      add_corner(bundle, v, static_cast<std::size_t>(bundle.views[v]->points[i]), free, equations);
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
  int seen = 0;
  for (const cv::Vec3d& point : points) {
    CornerDerivatives corner;
    if (!differentiate(lens, intrinsics, camera_from_board, point, corner, nullptr)) continue;
    equations.add(corner, columns);
    ++seen;
  }
  if (seen < 4) return cv::Mat_<double>(count, count, 0.0);
  equations.end_pose();
  return equations.shared();
}

}  // namespace calib
