#pragma once

#include <optional>
#include <vector>

#include "calib/boards/board.h"
#include "calib/boards/observation.h"
#include "calib/solve/solver.h"

namespace calib {

// Cross-validation: the views are dealt into folds (five, or one view each where there are fewer than ten); each fold
// is predicted by a solution of the others, its own poses fitted. NaN below three used views.
double held_out_rms_px(const Board& board, const Observations& observations, const Solution& solution,
                       const SolveOptions& options, int* folds);

// Solves with each lens and keeps the simplest whose held-out RMS is within a tenth of the best one's: what a richer
// lens would explain beyond that is less than half of the noise. nullopt when none can be solved.
struct LensTrial {
  LensChoice lens = LensChoice::Pinhole;
  bool solved = false;
  double rms_px = 0.0;
  double held_out_rms_px = 0.0;
};
std::optional<LensChoice> choose_lens(const Board& board, const Observations& observations, const SolveOptions& options,
                                      std::vector<LensTrial>* trials);

}  // namespace calib
