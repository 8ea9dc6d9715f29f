#pragma once

#include <string>

#include "calib/boards/board.h"

namespace app {

struct BoardCheck {
  bool fits = false;
  std::string text;
};

// What of the board a photograph shows, what is missing, what does not belong, and how well the places agree with the
// board's file. The lens bends straight lines: places are compared over neighbours, and over the whole board roughly.
BoardCheck check_board_photo(const calib::Board& board, const std::string& photo);

}  // namespace app
