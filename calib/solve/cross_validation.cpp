#include "calib/solve/cross_validation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace calib {

double held_out_rms_px(const Board& board, const Observations& observations, const Solution& solution,
                       const SolveOptions& options, int* folds) {
  const std::vector<std::size_t> used = solution.used_views();
  const int fold_count = static_cast<int>(used.size() < 10 ? used.size() : 5);
  if (folds != nullptr) *folds = fold_count;
  if (used.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  int count = 0;
  for (int fold = 0; fold < fold_count; ++fold) {
    Observations others = observations;
    others.views.clear();
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (static_cast<int>(i) % fold_count != fold) others.views.push_back(observations.views[used[i]]);
    }
    SolveOptions again = options;
    again.start = solution.camera;
    const auto trained = solve(board, others, again);
    if (!trained) return std::numeric_limits<double>::infinity();
    // A board whose errors were solved for is the board that the others showed.
    Board as_learnt = board;
    for (std::size_t p = 0; p < trained->board_error.size(); ++p) as_learnt.points[p] += trained->board_error[p];
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (static_cast<int>(i) % fold_count != fold) continue;
      const std::vector<bool>& corners = solution.views[used[i]].used;
      const auto fit = fit_view(as_learnt, observations.views[used[i]], corners, trained->camera);
      if (!fit) return std::numeric_limits<double>::infinity();
      const auto n = static_cast<int>(std::count(corners.begin(), corners.end(), true));
      sum += fit->rms_px * fit->rms_px * n;
      count += n;
    }
  }
  return std::sqrt(sum / count);
}

std::optional<LensChoice> choose_lens(const Board& board, const Observations& observations, const SolveOptions& options,
                                      std::vector<LensTrial>* trials) {
  std::vector<LensTrial> all;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < lens_choice_names().size(); ++i) {
    SolveOptions attempt = options;
    attempt.lens = static_cast<LensChoice>(i);
    const auto solution = solve(board, observations, attempt);
    LensTrial trial{attempt.lens, solution.has_value(), 0.0, std::numeric_limits<double>::infinity()};
    if (solution) {
      trial.rms_px = solution->rms_px;
      trial.held_out_rms_px = held_out_rms_px(board, observations, *solution, attempt, nullptr);
      // Corners that a lens does not explain must not make it look better.
      const double all_points = solution->points_used + solution->points_rejected;
      trial.held_out_rms_px *= std::sqrt(all_points / std::max(1, solution->points_used));
    }
    if (trial.held_out_rms_px < best) best = trial.held_out_rms_px;
    all.push_back(trial);
  }
  if (trials != nullptr) *trials = all;
  for (const LensTrial& trial : all) {
    if (trial.solved && trial.held_out_rms_px <= 1.1 * best) return trial.lens;
  }
  for (const LensTrial& trial : all) {
    if (trial.solved && trial.lens == LensChoice::PlumbBob4) return trial.lens;
  }
  return std::nullopt;
}

}  // namespace calib
