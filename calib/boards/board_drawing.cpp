#include "calib/boards/board_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/aruco/dictionary.hpp>
#include <optional>
#include <stdexcept>

#include "ar/track/tag_face.h"

namespace calib {
namespace {

constexpr double kRulerRoom = 16.0;  // mm under the board for ruler and caption
constexpr double kQuiet = 4.0;       // mm of white round the board at least

// Black cells of a square pattern in its own plane: x right, y down from its middle, unit its side.
struct Pattern {
  std::vector<cv::Rect2d> black;
  double white = 0.0;  // margin that must stay white, in sides
};

// Cells in a row that are black become one rectangle.
Pattern pattern_from(const std::vector<std::vector<bool>>& is_black, double cell, double origin) {
  Pattern out;
  for (std::size_t r = 0; r < is_black.size(); ++r) {
    for (std::size_t c = 0; c < is_black[r].size();) {
      std::size_t end = c;
      while (end < is_black[r].size() && is_black[r][end]) ++end;
      if (end > c) {
        out.black.emplace_back(origin + cell * static_cast<double>(c), origin + cell * static_cast<double>(r),
                               cell * static_cast<double>(end - c), cell);
      }
      c = std::max(end, c + 1);
    }
  }
  return out;
}

Pattern tag_pattern(const std::string& family, int id, int border_bits) {
  const ar::TagFace face = ar::make_tag_face(family, id, 1.0);
  const auto cells = static_cast<std::size_t>(face.cells);
  const auto white = [&](std::size_t r, std::size_t c) { return face.white[r * cells + c] != 0; };
  if (border_bits == 1) {
    std::vector<std::vector<bool>> black(cells, std::vector<bool>(cells));
    for (std::size_t r = 0; r < cells; ++r) {
      for (std::size_t c = 0; c < cells; ++c) black[r][c] = !white(r, c);
    }
    Pattern out = pattern_from(black, face.cell_m, -0.5 * face.side_m());
    out.white = 0.5 * (face.side_m() - 1.0);
    return out;
  }
  // Kalibr: the code of 6 x 6 cells inside a border of two; in the stock face it begins at the fourth cell.
  constexpr std::size_t kSide = 10;
  std::vector<std::vector<bool>> black(kSide, std::vector<bool>(kSide, true));
  for (std::size_t r = 2; r < kSide - 2; ++r) {
    for (std::size_t c = 2; c < kSide - 2; ++c) black[r][c] = !white(r + 1, c + 1);
  }
  return pattern_from(black, 1.0 / kSide, -0.5);
}

Pattern marker_pattern(const std::string& dictionary, int id) {
  const auto known = cv::aruco::getPredefinedDictionary(charuco_dictionary(dictionary));
  const int side = known->markerSize + 2;
  cv::Mat image;
  known->drawMarker(id, side, image, 1);
  std::vector<std::vector<bool>> black(static_cast<std::size_t>(side),
                                       std::vector<bool>(static_cast<std::size_t>(side)));
  for (int r = 0; r < side; ++r) {
    for (int c = 0; c < side; ++c) {
      black[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = image.at<uchar>(r, c) < 128;
    }
  }
  return pattern_from(black, 1.0 / side, -0.5);
}

// What is black on the board, mm in the board's frame.
struct Drawing {
  std::vector<cv::Rect2d> black;
  std::vector<std::vector<cv::Point2d>> tilted;
  double white_mm = kQuiet;  // margin
};

void add_pattern(const Pattern& pattern, const ar::Rigid3& board_from_tag, double side_mm, Drawing& drawing) {
  const cv::Matx33d& r = board_from_tag.rotation;
  const bool upright = std::abs(r(0, 0) - 1.0) < 1e-9 && std::abs(r(1, 1) - 1.0) < 1e-9;
  const cv::Point2d middle(1e3 * board_from_tag.translation[0], 1e3 * board_from_tag.translation[1]);
  drawing.white_mm = std::max(drawing.white_mm, pattern.white * side_mm);
  for (const cv::Rect2d& cell : pattern.black) {
    if (upright) {
      drawing.black.emplace_back(middle + side_mm * cell.tl(), cv::Size2d(side_mm * cell.width, side_mm * cell.height));
      continue;
    }
    std::vector<cv::Point2d> polygon;
    for (const cv::Point2d& p :
         {cell.tl(), cv::Point2d(cell.br().x, cell.y), cell.br(), cv::Point2d(cell.x, cell.br().y)}) {
      polygon.push_back(middle + side_mm * cv::Point2d(r(0, 0) * p.x + r(0, 1) * p.y, r(1, 0) * p.x + r(1, 1) * p.y));
    }
    drawing.tilted.push_back(polygon);
  }
}

void add_squares(const Board& board, Drawing& drawing) {
  const int columns = board.kind == BoardKind::Chessboard ? board.columns + 1 : board.columns;
  const int rows = board.kind == BoardKind::Chessboard ? board.rows + 1 : board.rows;
  const double width = 1e3 * board.square_width_m;
  const double height = 1e3 * board.square_height_m;
  const int black_first = board.kind == BoardKind::Charuco && board.marker_first ? 1 : 0;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      if ((r + c) % 2 == black_first) drawing.black.emplace_back((c - 1) * width, (r - 1) * height, width, height);
    }
  }
}

// The black squares that touch a tag's corners in Kalibr's boards.
void add_gap_squares(const Board& board, const BoardTag& tag, Drawing& drawing) {
  const double gap = 1e3 * board.filled_gap_m;
  const double half = 0.5e3 * tag.size_m;
  const cv::Point2d middle(1e3 * tag.board_from_tag.translation[0], 1e3 * tag.board_from_tag.translation[1]);
  for (double x : {-half - gap, half}) {
    for (double y : {-half - gap, half}) drawing.black.emplace_back(middle.x + x, middle.y + y, gap, gap);
  }
}

// The same tags seen from the front: a flat layout may stand anywhere in space.
std::optional<std::vector<ar::Rigid3>> in_one_plane(const Board& board) {
  const ar::Rigid3 first_from_board = board.tags.front().board_from_tag.inverse();
  std::vector<ar::Rigid3> flat;
  for (const BoardTag& tag : board.tags) {
    const ar::Rigid3 pose = board.grid ? tag.board_from_tag : first_from_board * tag.board_from_tag;
    if (std::abs(pose.translation[2]) > 1e-6 || pose.rotation(2, 2) < 1.0 - 1e-9) return std::nullopt;
    flat.push_back(pose);
  }
  return flat;
}

std::vector<Drawing> drawings_of(const Board& board) {
  if (board.kind != BoardKind::Tags) {
    Drawing drawing;
    add_squares(board, drawing);
    for (const BoardTag& tag : board.tags) {
      add_pattern(marker_pattern(board.family, tag.id), tag.board_from_tag, 1e3 * tag.size_m, drawing);
    }
    return {drawing};
  }
  std::vector<Drawing> drawings(1);
  const auto flat = in_one_plane(board);
  for (std::size_t t = 0; t < board.tags.size(); ++t) {
    const BoardTag& tag = board.tags[t];
    if (!flat && t > 0) drawings.emplace_back();
    add_pattern(tag_pattern(board.family, tag.id, board.border_bits), flat ? (*flat)[t] : ar::Rigid3{},
                1e3 * tag.size_m, drawings.back());
    if (board.filled_gap_m > 0.0) add_gap_squares(board, tag, drawings.back());
  }
  return drawings;
}

cv::Rect2d bounds_of(const Drawing& drawing) {
  cv::Point2d low(1e30, 1e30);
  cv::Point2d high(-1e30, -1e30);
  const auto include = [&](const cv::Point2d& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  };
  for (const cv::Rect2d& r : drawing.black) {
    include(r.tl());
    include(r.br());
  }
  for (const auto& polygon : drawing.tilted) std::for_each(polygon.begin(), polygon.end(), include);
  return {low, high};
}

struct Paper {
  const char* name;
  double width_mm;
  double height_mm;
};
constexpr std::array<Paper, 7> kPapers{{{"a4", 210.0, 297.0},
                                        {"a3", 297.0, 420.0},
                                        {"a2", 420.0, 594.0},
                                        {"a1", 594.0, 841.0},
                                        {"a0", 841.0, 1189.0},
                                        {"letter", 215.9, 279.4},
                                        {"tabloid", 279.4, 431.8}}};

// Upright if it fits so, else across.
std::optional<cv::Size2d> fitting(const Paper& paper, const cv::Size2d& needed) {
  if (needed.width <= paper.width_mm && needed.height <= paper.height_mm) {
    return cv::Size2d(paper.width_mm, paper.height_mm);
  }
  if (needed.width <= paper.height_mm && needed.height <= paper.width_mm) {
    return cv::Size2d(paper.height_mm, paper.width_mm);
  }
  return std::nullopt;
}

cv::Size2d choose_paper(const PaperOptions& options, const cv::Size2d& needed) {
  for (const Paper& paper : kPapers) {
    const bool automatic = options.paper == "auto" && paper.name[0] == 'a';
    if (!automatic && options.paper != paper.name) continue;
    if (const auto size = fitting(paper, needed)) return *size;
  }
  throw std::runtime_error(
      fmt::format("the board with its margins takes {:.0f} x {:.0f} mm and does not fit on {} paper\n"
                  "make it smaller, or give a larger --paper: a4, a3, a2, a1, a0, letter, tabloid",
                  needed.width, needed.height, options.paper == "auto" ? "any" : options.paper));
}

Page page_of(const Board& board, const Drawing& drawing, const PaperOptions& options) {
  const cv::Rect2d bounds = bounds_of(drawing);
  const double around = std::max(options.margin_mm, drawing.white_mm);  // what is not printed is white too
  const cv::Size2d needed(bounds.width + 2.0 * around, bounds.height + 2.0 * around + kRulerRoom);
  const cv::Size2d paper = choose_paper(options, needed);
  Page page;
  page.width_mm = paper.width;
  page.height_mm = paper.height;
  const cv::Point2d shift(0.5 * (paper.width - bounds.width) - bounds.x,
                          0.5 * (paper.height - kRulerRoom - bounds.height) - bounds.y);
  for (const cv::Rect2d& r : drawing.black) page.black.emplace_back(r.tl() + shift, r.size());
  for (std::vector<cv::Point2d> polygon : drawing.tilted) {
    for (cv::Point2d& p : polygon) p += shift;
    page.tilted.push_back(std::move(polygon));
  }
  const double room = paper.width - 2.0 * options.margin_mm;
  page.ruler_mm = std::min(100.0, std::floor(room / 10.0) * 10.0);
  const double bottom = paper.height - options.margin_mm;
  page.ruler_at = {options.margin_mm, bottom - 6.0};
  page.caption_at = {options.margin_mm, bottom - 10.0};
  page.caption = board.description + "; print at 100 %, then measure the ruler";
  return page;
}

}  // namespace

std::vector<Page> draw_board(const Board& board, const PaperOptions& options) {
  std::vector<Page> pages;
  for (const Drawing& drawing : drawings_of(board)) pages.push_back(page_of(board, drawing, options));
  return pages;
}

}  // namespace calib
