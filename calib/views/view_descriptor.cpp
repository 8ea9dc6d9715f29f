#include "calib/views/view_descriptor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "render/base/median.h"

namespace calib {
double distance(const ViewDescriptor& a, const ViewDescriptor& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

double median_shift_px(const Observation& a, const Observation& b) {
  std::vector<double> shifts;
  for (std::size_t i = 0, k = 0; i < a.points.size() && k < b.points.size();) {
    if (a.points[i] == b.points[k]) {
      shifts.push_back(cv::norm(a.px[i++] - b.px[k++]));
    } else {
      (a.points[i] < b.points[k] ? i : k) += 1;
    }
  }
  return shifts.empty() ? std::numeric_limits<double>::infinity() : render::upper_median(shifts);
}

ViewDescriptor descriptor_of(const Board& board, const Observation& view, double picture_px) {
  cv::Point2d mean;
  for (const cv::Point2d& p : view.px) mean += p / static_cast<double>(view.px.size());
  ViewDescriptor descriptor{mean.x / picture_px, mean.y / picture_px, 0.0, 0.0, 0.0};
  std::vector<cv::Point2d> on_board;
  for (int p : view.points) {
    const cv::Vec3d& at = board.points[static_cast<std::size_t>(p)];
    on_board.emplace_back(at[0] / board.diagonal_m(), at[1] / board.diagonal_m());
  }
  const cv::Mat homography = cv::findHomography(on_board, view.px);
  if (homography.empty()) return descriptor;
  const cv::Matx33d h(homography);
  // The perspective terms say how the board leans; its size is how far away it is.
  const double size = std::sqrt(std::abs(cv::determinant(h.get_minor<2, 2>(0, 0)))) / picture_px;
  descriptor[2] = 0.5 * std::log2(std::max(1e-3, size));
  descriptor[3] = 2.0 * h(2, 0);
  descriptor[4] = 2.0 * h(2, 1);
  return descriptor;
}

}  // namespace calib
