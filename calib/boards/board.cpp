#include "calib/boards/board.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <opencv2/aruco/dictionary.hpp>
#include <stdexcept>

#include "render/base/check.h"

namespace calib {
namespace {

// In the order of cv::aruco::PREDEFINED_DICTIONARY_NAME.
const std::vector<std::string> kDictionaries{
    "DICT_4X4_50",        "DICT_4X4_100",        "DICT_4X4_250",       "DICT_4X4_1000",      "DICT_5X5_50",
    "DICT_5X5_100",       "DICT_5X5_250",        "DICT_5X5_1000",      "DICT_6X6_50",        "DICT_6X6_100",
    "DICT_6X6_250",       "DICT_6X6_1000",       "DICT_7X7_50",        "DICT_7X7_100",       "DICT_7X7_250",
    "DICT_7X7_1000",      "DICT_ARUCO_ORIGINAL", "DICT_APRILTAG_16h5", "DICT_APRILTAG_25h9", "DICT_APRILTAG_36h10",
    "DICT_APRILTAG_36h11"};

std::string mm(double metres) {
  return fmt::format("{:.6g} mm", metres * 1000.0);
}

void add_tag(Board& board, int id, double size_m, const ar::Rigid3& board_from_tag) {
  board.tags.push_back({id, static_cast<int>(board.points.size()), size_m, board_from_tag});
  for (const cv::Vec3d& corner : ar::corners_in_tag(size_m)) board.points.push_back(board_from_tag * corner);
}

void add_inner_corners(Board& board, int columns, int rows) {
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      board.points.emplace_back(c * board.square_width_m, r * board.square_height_m, 0.0);
    }
  }
}

struct Box {
  cv::Vec3d low = cv::Vec3d::all(std::numeric_limits<double>::infinity());
  cv::Vec3d high = -low;
};

Box box_of(const Board& board) {
  Box box;
  for (const cv::Vec3d& p : board.points) {
    for (int i = 0; i < 3; ++i) {
      box.low[i] = std::min(box.low[i], p[i]);
      box.high[i] = std::max(box.high[i], p[i]);
    }
  }
  return box;
}

}  // namespace

bool Board::is_flat() const {
  cv::Mat table(static_cast<int>(points.size()), 3, CV_64F);
  for (int i = 0; i < table.rows; ++i) {
    for (int k = 0; k < 3; ++k) table.at<double>(i, k) = points[static_cast<std::size_t>(i)][k];
  }
  cv::Mat mean;
  cv::reduce(table, mean, 0, cv::REDUCE_AVG);
  for (int i = 0; i < table.rows; ++i) table.row(i) -= mean;
  cv::Mat spread;
  cv::SVD::compute(table.t() * table, spread, cv::noArray(), cv::noArray(), cv::SVD::NO_UV);
  return spread.at<double>(2) <= 1e-8 * spread.at<double>(0);
}

double Board::diagonal_m() const {
  const Box box = box_of(*this);
  return cv::norm(box.high - box.low);
}

double Board::unit_m() const {
  if (kind != BoardKind::Tags) return std::min(square_width_m, square_height_m);
  const auto smaller = [](const BoardTag& a, const BoardTag& b) { return a.size_m < b.size_m; };
  return std::min_element(tags.begin(), tags.end(), smaller)->size_m;
}

Board make_chessboard(int columns, int rows, double square_width_m, double square_height_m) {
  CHECK(columns >= 2);
  CHECK(rows >= 2);
  CHECK(std::min(square_width_m, square_height_m) > 0.0);
  Board board;
  board.kind = BoardKind::Chessboard;
  board.columns = columns;
  board.rows = rows;
  board.square_width_m = square_width_m;
  board.square_height_m = square_height_m;
  add_inner_corners(board, columns, rows);
  board.description = fmt::format(
      "chessboard, {} x {} inner corners, squares of {}", columns, rows,
      square_width_m == square_height_m ? mm(square_width_m) : mm(square_width_m) + " x " + mm(square_height_m));
  return board;
}

Board make_charuco(const std::string& dictionary, int columns, int rows, double square_m, double marker_m,
                   bool marker_first) {
  CHECK(columns >= 3);
  CHECK(rows >= 3);
  if (!(marker_m > 0.0 && marker_m < square_m)) {
    throw std::runtime_error(fmt::format(
        "ChArUco: markers of {} in squares of {}\nmarkers must be smaller than squares", mm(marker_m), mm(square_m)));
  }
  Board board;
  board.kind = BoardKind::Charuco;
  board.family = dictionary;
  board.columns = columns;
  board.rows = rows;
  board.square_width_m = board.square_height_m = square_m;
  board.marker_m = marker_m;
  board.marker_first = marker_first;
  add_inner_corners(board, columns - 1, rows - 1);
  const int known = cv::aruco::getPredefinedDictionary(charuco_dictionary(dictionary))->bytesList.rows;
  int id = 0;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const bool light = ((r + c) % 2 == 0) == marker_first;
      if (!light) continue;
      const cv::Vec3d middle((c - 0.5) * square_m, (r - 0.5) * square_m, 0.0);  // the first inner corner is the origin
      board.tags.push_back({id++, 0, marker_m, {cv::Matx33d::eye(), middle}});
    }
  }
  if (id > known) {
    throw std::runtime_error(
        fmt::format("ChArUco: {} x {} squares need {} markers, {} has {}\ntake a larger dictionary", columns, rows, id,
                    dictionary, known));
  }
  board.description = fmt::format("ChArUco, {} x {} squares of {}, markers of {} from {}", columns, rows, mm(square_m),
                                  mm(marker_m), dictionary);
  return board;
}

Board make_tag_grid(const GridSpec& spec) {
  CHECK(spec.columns >= 1);
  CHECK(spec.rows >= 1);
  CHECK(spec.size_m > 0.0);
  Board board;
  board.kind = BoardKind::Tags;
  board.family = spec.family;
  board.border_bits = spec.border_bits;
  board.filled_gap_m = spec.filled_gaps ? std::min(spec.gap_x_m, spec.gap_y_m) : 0.0;
  board.grid = true;
  board.order = spec.order;
  board.columns = spec.columns;
  board.rows = spec.rows;
  for (int r = 0; r < spec.rows; ++r) {
    for (int c = 0; c < spec.columns; ++c) {
      const int row_of_id = spec.order == GridOrder::TopLeft ? r : spec.rows - 1 - r;
      const cv::Vec3d middle(c * (spec.size_m + spec.gap_x_m), r * (spec.size_m + spec.gap_y_m), 0.0);
      add_tag(board, spec.first_id + row_of_id * spec.columns + c, spec.size_m, {cv::Matx33d::eye(), middle});
    }
  }
  board.description = fmt::format("{} grid, {} x {} tags of {}, gaps of {} and {}{}", spec.family, spec.columns,
                                  spec.rows, mm(spec.size_m), mm(spec.gap_x_m), mm(spec.gap_y_m),
                                  spec.border_bits == 2 ? ", two-bit borders (Kalibr)" : "");
  return board;
}

Board make_layout(const ar::TagMap& map) {
  if (map.tags.empty()) throw std::runtime_error("a board of no tags\nname at least one");
  Board board;
  board.kind = BoardKind::Tags;
  board.family = map.family;
  for (const auto& [id, tag] : map.tags) add_tag(board, id, tag.size_m, tag.world_from_tag);
  board.description = map.tags.size() == 1
                          ? fmt::format("{} tag {} of {}", map.family, map.tags.begin()->first, mm(board.unit_m()))
                          : fmt::format("layout of {} {} tags", map.tags.size(), map.family);
  return board;
}

const std::vector<std::string>& charuco_dictionaries() {
  return kDictionaries;
}

int charuco_dictionary(const std::string& name) {
  const auto found = std::find(kDictionaries.begin(), kDictionaries.end(), name);
  if (found == kDictionaries.end()) {
    throw std::runtime_error(
        fmt::format("unknown ArUco dictionary '{}'\nknown: {}", name, fmt::join(kDictionaries, ", ")));
  }
  return static_cast<int>(found - kDictionaries.begin());
}

cv::Vec3d middle_of(const Board& board) {
  cv::Vec3d sum(0.0, 0.0, 0.0);
  for (const cv::Vec3d& p : board.points) sum += p;
  return sum / static_cast<double>(board.points.size());
}

}  // namespace calib
