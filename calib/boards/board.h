#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ar/track/pose.h"
#include "ar/track/tag_map.h"

namespace calib {

// A calibration board is a list of points of known place whose pictures can be measured. Its frame: metres, x right,
// y down, z into the board as its face is looked at, origin at the first point or tag of the top row; a layout of tags
// keeps the frame of its file.
enum class BoardKind { Tags, Charuco, Chessboard };

// Which corner of a grid its first tag has; ids grow along the row, then row by row.
enum class GridOrder { TopLeft, BottomLeft };

// Its corners are the board's points first_point ... first_point + 3, in the library's order (left-bottom,
// right-bottom, right-top, left-top). A ChArUco board's markers are no points of the board.
struct BoardTag {
  int id = 0;
  int first_point = 0;
  double size_m = 0.0;  // outer edge of the black border
  ar::Rigid3 board_from_tag;
};

struct Board {
  BoardKind kind = BoardKind::Chessboard;
  std::string description;  // for people: "chessboard, 9 x 6 inner corners, squares of 25 mm"
  std::string family;       // of tags; of ChArUco the name of OpenCV's dictionary
  int border_bits = 1;      // width of the tags' black border in cells: Kalibr's have 2
  double filled_gap_m = 0;  // side of the black squares between tags (Kalibr), 0: none
  bool grid = false;        // tags stand in columns and rows
  GridOrder order = GridOrder::TopLeft;
  int columns = 0;  // inner corners of a chessboard, squares of ChArUco, tags of a grid
  int rows = 0;
  double square_width_m = 0.0;  // chessboard and ChArUco
  double square_height_m = 0.0;
  double marker_m = 0.0;      // ChArUco
  bool marker_first = false;  // ChArUco: a marker, not black, in the top left square
  std::vector<BoardTag> tags;
  std::vector<cv::Vec3d> points;

  // Whether all points lie in one plane.
  bool is_flat() const;
  // Length of the diagonal of the points' bounding box, m.
  double diagonal_m() const;
  // The size of what is measured: a square's or the smallest tag's side, m.
  double unit_m() const;
};

cv::Vec3d middle_of(const Board& board);  // of all points, metres

// Inner corners row by row from the top left. Columns and rows >= 2, sizes > 0.
Board make_chessboard(int columns, int rows, double square_width_m, double square_height_m);

// OpenCV's ChArUco: markers with ids from 0 in the light squares, row by row from the top left; the points are the
// inner corners. `dictionary` as OpenCV names it ("DICT_5X5_1000"). `marker_first`: boards of OpenCV before 4.7 with an
// even number of rows. Throws std::runtime_error: unknown dictionary, too few markers in it, a marker that fills its
// square.
Board make_charuco(const std::string& dictionary, int columns, int rows, double square_m, double marker_m,
                   bool marker_first);

// A grid of tags of one size. Gaps between neighbours' borders, metres.
struct GridSpec {
  std::string family = "tag36h11";
  int columns = 0;
  int rows = 0;
  int first_id = 0;
  double size_m = 0.0;
  double gap_x_m = 0.0;
  double gap_y_m = 0.0;
  GridOrder order = GridOrder::TopLeft;
  int border_bits = 1;       // 2: Kalibr's
  bool filled_gaps = false;  // Kalibr's black squares, which touch the tags' corners
};
Board make_tag_grid(const GridSpec& spec);

// Any rigid layout, a single tag included. Throws std::runtime_error when it is empty.
Board make_layout(const ar::TagMap& map);

// OpenCV's predefined dictionaries of ArUco markers.
const std::vector<std::string>& charuco_dictionaries();
// Their number in OpenCV, for cv::aruco::getPredefinedDictionary(). Throws std::runtime_error that lists the names.
int charuco_dictionary(const std::string& name);

}  // namespace calib
