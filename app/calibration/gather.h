#pragma once

#include <string>
#include <vector>

#include "calib/boards/board.h"
#include "calib/boards/observation.h"

namespace app {

struct GatherOptions {
  std::vector<std::string> inputs;
  std::string corners_cache;
  int most_views = 40;  // to choose from a recording
  bool quiet = false;
};

struct Gathered {
  calib::Observations observations;  // with the board in them
  int pictures = 0;                  // looked at
  int with_board = 0;
  bool interrupted = false;  // by a signal; the rest was not looked at, and the observations are not filled in
};

// Finds the board in all inputs. Pictures all count; of each recording the frames that calib::choose_views() picks.
// Throws ar::InputError: an input that cannot be read, pictures of different sizes, no board in any (with what is there
// instead: another family's tags, a mirrored board, a chessboard of another size, blur).
Gathered gather(const calib::Board& board, const GatherOptions& options);

}  // namespace app
