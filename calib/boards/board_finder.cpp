#include "calib/boards/board_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "ar/track/detector.h"
#include "render/base/check.h"
#include "render/base/median.h"

namespace calib {
namespace {

// Corners of tags by id, library's order.
using Corners = std::array<cv::Point2d, 4>;
using FoundTags = std::map<int, Corners>;

double shortest_side(const Corners& c) {
  double side = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 4; ++i) side = std::min(side, cv::norm(c[i] - c[(i + 1) % 4]));
  return side;
}

// Which id is meant when two tags bear it cannot be told: neither counts.
class TagCollector {
 public:
  void add(int id, const Corners& corners) {
    if (!found_.emplace(id, corners).second) twice_.insert(id);
  }
  FoundTags take() {
    for (int id : twice_) found_.erase(id);
    return std::move(found_);
  }

 private:
  FoundTags found_;
  std::set<int> twice_;
};

// The library's order from OpenCV's (left-top, right-top, right-bottom, left-bottom of the marker as OpenCV prints it).
Corners library_order(const std::vector<cv::Point2f>& c, bool upside_down) {
  const std::size_t turn = upside_down ? 2 : 0;
  Corners out;
  for (std::size_t i = 0; i < 4; ++i) out[i] = c[(3 - i + turn) % 4];
  return out;
}

// Squares that are large in a large picture are found in a smaller one in a fraction of the time.
double search_scale(const cv::Size& size, int enough_px) {
  return std::min(1.0, static_cast<double>(enough_px) / std::max(size.width, size.height));
}

cv::Mat shrunk(const cv::Mat& grey8, double scale) {
  if (scale == 1.0) return grey8;
  cv::Mat small;
  cv::resize(grey8, small, {}, scale, scale, cv::INTER_AREA);
  return small;
}

// Pixel centres are whole numbers: the edges, half a pixel outside, are what both sizes share.
cv::Point2d unshrunk(const cv::Point2f& p, double scale) {
  return {(p.x + 0.5) / scale - 0.5, (p.y + 0.5) / scale - 0.5};
}

std::vector<double> nearest_neighbours(const std::vector<cv::Point2d>& px) {
  std::vector<double> nearest(px.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < px.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double distance = cv::norm(px[i] - px[k]);
      nearest[i] = std::min(nearest[i], distance);
      nearest[k] = std::min(nearest[k], distance);
    }
  }
  return nearest;
}

void keep_finite(Observation& seen) {
  Observation kept = seen;
  kept.points.clear();
  kept.px.clear();
  for (std::size_t i = 0; i < seen.px.size(); ++i) {
    if (!std::isfinite(seen.px[i].x)) continue;
    kept.points.push_back(seen.points[i]);
    kept.px.push_back(seen.px[i]);
  }
  seen = std::move(kept);
}

}  // namespace

struct BoardFinder::Impl {
  const Board& board;
  std::unique_ptr<ar::Detector> detector;  // tags with the stock border
  cv::Ptr<cv::aruco::Dictionary> dictionary;
  cv::Ptr<cv::aruco::DetectorParameters> parameters;

  Impl(const Board& b, int threads) : board(b) {
    if (board.kind == BoardKind::Tags && board.border_bits == 1) {
      ar::DetectorOptions options;
      options.families = {board.family};
      options.threads = threads;
      detector = std::make_unique<ar::Detector>(options);
    } else if (board.kind != BoardKind::Chessboard) {
      const std::string name = board.kind == BoardKind::Charuco ? board.family : "DICT_APRILTAG_36h11";
      dictionary = cv::aruco::getPredefinedDictionary(charuco_dictionary(name));
      parameters = cv::aruco::DetectorParameters::create();
      parameters->markerBorderBits = board.border_bits;
    }
  }

  FoundTags find_markers(const cv::Mat& grey8);
  Observation find_tags(const cv::Mat& grey8);
  Observation find_charuco(const cv::Mat& grey8);
  Observation find_chessboard(const cv::Mat& grey8, Effort effort) const;
};

FoundTags BoardFinder::Impl::find_markers(const cv::Mat& grey8) {
  TagCollector tags;
  if (detector) {
    for (const ar::Detection& d : detector->detect(grey8)) tags.add(d.id, d.corners_px);
    return tags.take();
  }
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  const double scale = search_scale(grey8.size(), 2048);
  cv::aruco::detectMarkers(shrunk(grey8, scale), dictionary, corners, ids, parameters);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Corners found = library_order(corners[i], board.kind == BoardKind::Tags);
    for (cv::Point2d& p : found) p = unshrunk(p, scale);
    tags.add(ids[i], found);
  }
  return tags.take();
}

Observation BoardFinder::Impl::find_tags(const cv::Mat& grey8) {
  Observation seen;
  const FoundTags found = find_markers(grey8);
  std::vector<double> reach;
  std::set<int> foreign;
  for (const auto& [id, corners] : found) foreign.insert(id);
  for (const BoardTag& tag : board.tags) {
    const auto match = found.find(tag.id);
    if (match == found.end()) continue;
    foreign.erase(tag.id);
    for (int i = 0; i < 4; ++i) {
      seen.points.push_back(tag.first_point + i);
      seen.px.push_back(match->second[static_cast<std::size_t>(i)]);
      reach.push_back(0.4 * shortest_side(match->second) * board.filled_gap_m / tag.size_m);
    }
  }
  seen.foreign_ids.assign(foreign.begin(), foreign.end());
  if (board.filled_gap_m > 0.0) {
    refine_saddles(grey8, seen.px, reach);
    keep_finite(seen);
  }
  return seen;
}

// Every inner corner lies between two markers; where it is comes from the markers around it, how exactly from the
// saddle there.
Observation BoardFinder::Impl::find_charuco(const cv::Mat& grey8) {
  const FoundTags found = find_markers(grey8);
  Observation seen;
  std::set<int> foreign;
  for (const auto& [id, corners] : found) foreign.insert(id);
  for (const BoardTag& tag : board.tags) foreign.erase(tag.id);
  seen.foreign_ids.assign(foreign.begin(), foreign.end());
  std::vector<double> reach;
  for (std::size_t i = 0; i < board.points.size(); ++i) {
    std::vector<cv::Point2d> on_board;
    std::vector<cv::Point2d> in_picture;
    int touching = 0;
    double side = std::numeric_limits<double>::infinity();
    for (const BoardTag& tag : board.tags) {
      const cv::Vec3d off = tag.board_from_tag.translation - board.points[i];
      const double squares = std::max(std::abs(off[0]), std::abs(off[1])) / board.square_width_m;
      const auto match = found.find(tag.id);
      if (squares > 1.6 || match == found.end()) continue;
      const auto in_tag = ar::corners_in_tag(tag.size_m);
      for (std::size_t k = 0; k < 4; ++k) {
        const cv::Vec3d p = tag.board_from_tag * in_tag[k];
        on_board.emplace_back(p[0], p[1]);
        in_picture.push_back(match->second[k]);
      }
      if (squares > 0.6) continue;
      ++touching;
      side = std::min(side, shortest_side(match->second));
    }
    if (touching == 0) continue;
    const cv::Mat homography = cv::findHomography(on_board, in_picture);
    if (homography.empty()) continue;
    std::vector<cv::Point2d> place{{board.points[i][0], board.points[i][1]}};
    cv::perspectiveTransform(place, place, homography);
    seen.points.push_back(static_cast<int>(i));
    seen.px.push_back(place[0]);
    // The marker's black border begins where the square's light margin ends.
    reach.push_back(std::max(0.9 * side * 0.5 * (board.square_width_m / board.marker_m - 1.0), 2.0));
  }
  refine_saddles(grey8, seen.px, reach);
  keep_finite(seen);
  return seen;
}

Observation BoardFinder::Impl::find_chessboard(const cv::Mat& grey8, Effort effort) const {
  const cv::Size pattern(board.columns, board.rows);
  const double scale = search_scale(grey8.size(), 1280);
  const cv::Mat small = shrunk(grey8, scale);
  std::vector<cv::Point2f> corners;
  const int quick = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  const int thorough = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE;
  const auto with_patience = [&] {
    return cv::findChessboardCorners(small, pattern, corners, thorough) ||
           cv::findChessboardCornersSB(small, pattern, corners, cv::CALIB_CB_NORMALIZE_IMAGE);
  };
  if (!cv::findChessboardCorners(small, pattern, corners, quick) && (effort == Effort::Quick || !with_patience())) {
    return {};
  }
  Observation seen;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    seen.points.push_back(static_cast<int>(i));
    seen.px.push_back(unshrunk(corners[i], scale));
  }
  std::vector<double> reach = nearest_neighbours(seen.px);
  for (double& r : reach) r *= 0.3;
  refine_saddles(grey8, seen.px, reach);
  keep_finite(seen);
  return seen;
}

BoardFinder::BoardFinder(const Board& board, int threads) : impl_(std::make_unique<Impl>(board, threads)) {}
BoardFinder::~BoardFinder() = default;

Observation BoardFinder::find(const cv::Mat& grey8, Effort effort) {
  CV_CheckTypeEQ(grey8.type(), CV_8UC1, "a grey picture of 8 bits");
  Observation seen = impl_->board.kind == BoardKind::Tags      ? impl_->find_tags(grey8)
                     : impl_->board.kind == BoardKind::Charuco ? impl_->find_charuco(grey8)
                                                               : impl_->find_chessboard(grey8, effort);
  seen.edge_width_px = edge_width_px(grey8, seen.px, 6);
  return seen;
}

void refine_saddles(const cv::Mat& grey8, std::vector<cv::Point2d>& px, const std::vector<double>& reach_px) {
  CHECK(px.size() == reach_px.size());
  const cv::Rect inside(2, 2, grey8.cols - 4, grey8.rows - 4);
  for (std::size_t i = 0; i < px.size(); ++i) {
    const cv::Point2d start = px[i];
    px[i] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    if (!inside.contains(cv::Point(start))) continue;
    const int reach = static_cast<int>(std::clamp(std::round(reach_px[i]), 2.0, 15.0));
    std::vector<cv::Point2f> corner{start};
    cv::cornerSubPix(grey8, corner, {reach, reach}, {-1, -1},
                     {cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 60, 1e-4});
    const cv::Point2d end = corner[0];
    const cv::Point2d shift = end - start;
    if (std::max(std::abs(shift.x), std::abs(shift.y)) <= reach) px[i] = end;
  }
}

double edge_width_px(const cv::Mat& grey8, const std::vector<cv::Point2d>& px, int radius) {
  std::vector<double> widths;
  for (const cv::Point2d& p : px) {
    const cv::Rect box = cv::Rect(cvRound(p.x) - radius, cvRound(p.y) - radius, 2 * radius + 1, 2 * radius + 1) &
                         cv::Rect(0, 0, grey8.cols, grey8.rows);
    if (box.width < 5 || box.height < 5) continue;
    const cv::Mat patch = grey8(box);
    double low = 0.0;
    double high = 0.0;
    cv::minMaxLoc(patch, &low, &high);
    cv::Mat dx;
    cv::Mat dy;
    cv::Sobel(patch, dx, CV_32F, 1, 0, 3, 1.0 / 8.0);
    cv::Sobel(patch, dy, CV_32F, 0, 1, 3, 1.0 / 8.0);
    cv::Mat slope;
    cv::magnitude(dx, dy, slope);
    double steepest = 0.0;
    cv::minMaxLoc(slope, nullptr, &steepest);
    if (steepest > 0.0) widths.push_back((high - low) / steepest);
  }
  return widths.empty() ? 0.0 : render::upper_median(std::move(widths));
}

}  // namespace calib
