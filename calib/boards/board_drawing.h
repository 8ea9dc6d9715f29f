#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "calib/boards/board.h"

namespace calib {

// What is printed black on a page, mm from the page's top left corner.
struct Page {
  double width_mm = 0.0;
  double height_mm = 0.0;
  std::vector<cv::Rect2d> black;                 // axis-parallel
  std::vector<std::vector<cv::Point2d>> tilted;  // polygons, of tags that stand obliquely in a flat layout
  double ruler_mm = 0.0;                         // 0: no room for one
  cv::Point2d ruler_at;                          // its left end
  std::string caption;
  cv::Point2d caption_at;
};

struct PaperOptions {
  std::string paper = "auto";  // a4, a3, a2, a1, a0, letter, tabloid; auto: the smallest of the A sizes that holds it
  double margin_mm = 10.0;     // that printers leave white
};

// The board at true scale, with a ruler and a caption under it; a layout that is not flat takes one page a tag. Throws
// std::runtime_error with the size needed when it does not fit on the paper.
std::vector<Page> draw_board(const Board& board, const PaperOptions& options);

// Writes pages as PDF or SVG (one page) with cairo, by the file's ending, or as PNG with so many dots an inch. Throws
// std::runtime_error.
void write_pages(const std::string& path, const std::vector<Page>& pages, double dpi);

}  // namespace calib
