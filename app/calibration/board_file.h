#pragma once

#include <string>

#include "calib/boards/board.h"

namespace app {

// A calibration board from what the user calls it: a board file (`skyshaft_board: 1`), a tag map (`skyshaft_tags: 1`),
// Kalibr's target YAML (aprilgrid, checkerboard), or a short form
//   chessboard:9x6:25mm   charuco:12x8:18mm:14mm:DICT_5X5_1000   aprilgrid:5x6:30mm:0.3[:tag36h11]
//   tag:7:160mm[:tag36h11]
// with lengths in metres, mm or cm, and an aprilgrid's gap in tag sizes. Throws ar::InputError (files: with line and
// key) or UsageError (short form).
calib::Board read_board(const std::string& specification);

// The board as a board file that read_board() reads.
std::string board_text(const calib::Board& board);

// One page on all of the above, for --help.
extern const char* const kBoardHelp;

}  // namespace app
