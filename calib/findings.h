#pragma once

#include <vector>

#include "calib/board.h"
#include "calib/judge.h"

namespace calib {

// What speaks against a solution, by the gates of docs/calibration.md; those that reject it come first. Of the
// judgement, all but findings and verdict is filled in.
std::vector<Finding> findings_of(const Board& board, const Solution& solution, const Judgement& judgement);

}  // namespace calib
