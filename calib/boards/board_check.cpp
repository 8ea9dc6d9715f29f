#include "calib/boards/board_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "ar/track/detector.h"
#include "calib/boards/board_finder.h"
#include "render/base/median.h"

namespace calib {
namespace {

// Pictures of a tag's corners by its index on the board.
std::map<std::size_t, std::vector<cv::Point2d>> tags_in(const Board& board, const Observation& view) {
  std::map<int, std::size_t> tag_of_first_point;
  for (std::size_t t = 0; t < board.tags.size(); ++t) tag_of_first_point[board.tags[t].first_point] = t;
  std::map<std::size_t, std::vector<cv::Point2d>> tags;
  for (std::size_t i = 0; i < view.points.size(); ++i) {
    tags[tag_of_first_point.at(view.points[i] / 4 * 4)].push_back(view.px[i]);
  }
  std::erase_if(tags, [](const auto& entry) { return entry.second.size() != 4; });
  return tags;
}

// The nearest two others of each tag: those whose step the first one's corners can measure.
std::vector<std::pair<std::size_t, std::size_t>> neighbours(const Board& board) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < board.tags.size(); ++a) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t b = 0; b < board.tags.size(); ++b) {
      const cv::Vec3d off = board.tags[b].board_from_tag.translation - board.tags[a].board_from_tag.translation;
      if (b != a) others.emplace_back(cv::norm(off), b);
    }
    std::sort(others.begin(), others.end());
    for (std::size_t i = 0; i < std::min<std::size_t>(4, others.size()); ++i) pairs.emplace_back(a, others[i].second);
  }
  return pairs;
}

// The middle of the second tag in the first one's frame, in its sizes.
std::optional<cv::Point2d> step_seen(const std::vector<cv::Point2d>& from, const std::vector<cv::Point2d>& to) {
  const std::vector<cv::Point2d> square{{-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}};
  const cv::Mat tag_from_picture = cv::findHomography(from, square);
  if (tag_from_picture.empty()) return std::nullopt;
  std::vector<cv::Point2d> corners;
  cv::perspectiveTransform(to, corners, tag_from_picture);
  // A tag's middle is where its diagonals meet.
  const cv::Point2d one = corners[2] - corners[0];
  const cv::Point2d two = corners[3] - corners[1];
  const double turn = one.cross(two);
  if (std::abs(turn) < 1e-12) return std::nullopt;
  return corners[0] + one * ((corners[1] - corners[0]).cross(two) / turn);
}

std::vector<int> chessboard_size(const cv::Mat& grey8) {
  std::vector<cv::Point2f> corners;
  cv::Mat meta;
  const int flags = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_LARGER;
  try {
    if (!cv::findChessboardCornersSB(grey8, {3, 3}, corners, flags, meta)) return {};
  } catch (const cv::Exception&) {
    return {};
  }
  return {meta.cols, meta.rows};
}

}  // namespace

std::vector<TagStep> compare_steps(const Board& board, const std::vector<Observation>& views, int fewest_views) {
  if (board.kind != BoardKind::Tags || !board.is_flat()) return {};
  const auto pairs = neighbours(board);
  std::vector<std::vector<cv::Point2d>> seen(pairs.size());
  for (const Observation& view : views) {
    const auto tags = tags_in(board, view);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto from = tags.find(pairs[i].first);
      const auto to = tags.find(pairs[i].second);
      if (from == tags.end() || to == tags.end()) continue;
      if (const auto step = step_seen(from->second, to->second)) seen[i].push_back(*step);
    }
  }
  std::vector<TagStep> steps;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (static_cast<int>(seen[i].size()) < std::max(1, fewest_views)) continue;
    const BoardTag& from = board.tags[pairs[i].first];
    const BoardTag& to = board.tags[pairs[i].second];
    const cv::Vec3d off = from.board_from_tag.inverse() * to.board_from_tag.translation;
    std::vector<double> x;
    std::vector<double> y;
    for (const cv::Point2d& p : seen[i]) {
      x.push_back(p.x);
      y.push_back(p.y);
    }
    steps.push_back({from.id,
                     to.id,
                     {render::upper_median(x), render::upper_median(y)},
                     {off[0] / from.size_m, off[1] / from.size_m}});
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const TagStep& a, const TagStep& b) { return a.error() > b.error(); });
  return steps;
}

std::optional<TagStep> wrong_step(const Board& board, const std::vector<Observation>& views, double tolerance) {
  const std::vector<TagStep> steps = compare_steps(board, views, 1);
  if (steps.size() < 2) return std::nullopt;
  // The one in the middle of the worst third: a wrong board shows in many steps, a bad corner in one or two.
  const TagStep& telling = steps[steps.size() / 6];
  if (steps[steps.size() / 3].error() <= tolerance) return std::nullopt;
  return telling;
}

OtherBoard look_for_others(const Board& board, const cv::Mat& grey8) {
  OtherBoard out;
  ar::DetectorOptions options;
  // tagStandard52h13 is left out: its table of codes takes seconds to build.
  options.families = {"tag36h11", "tag25h9", "tag16h5", "tagCircle21h7", "tagStandard41h12"};
  options.max_hamming = 0;
  options.min_margin = 40.0;
  std::erase(options.families, board.border_bits == 1 ? board.family : "");
  ar::Detector detector(options);
  std::map<std::string, std::vector<int>> ids;
  for (const ar::Detection& d : detector.detect(grey8)) ids[d.family].push_back(d.id);
  for (const auto& [family, found] : ids) {
    // Families with few codes find some in noise: one tag alone says nothing.
    if (found.size() < 2 || found.size() < out.ids.size()) continue;
    out.family = family;
    out.ids = found;
  }
  if (board.kind != BoardKind::Chessboard) {
    cv::Mat mirrored;
    cv::flip(grey8, mirrored, 1);
    out.mirrored = BoardFinder(board).find(mirrored).points.size() >= 8;
  }
  const std::vector<int> size = board.kind == BoardKind::Tags ? std::vector<int>{} : chessboard_size(grey8);
  if (size.size() == 2) out.chessboard = {size[0], size[1]};
  return out;
}

}  // namespace calib
