#pragma once

#include <vector>

#include "calib/boards/board.h"
#include "calib/verdict/quality_gates.h"

namespace calib {

// What speaks against a solution, by the gates of docs/calibration.md; those that reject it come first. Of the
// assessment, all but diagnostics and verdict is filled in.
std::vector<Diagnostic> diagnostics_of(const Board& board, const Solution& solution, const Assessment& assessment);

}  // namespace calib
