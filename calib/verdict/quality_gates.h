#pragma once

#include <string>
#include <vector>

#include "calib/boards/observation.h"
#include "calib/solve/solver.h"
#include "calib/solve/uncertainty.h"

namespace calib {

enum class Verdict { Good, Usable, Rejected };
const char* to_string(Verdict verdict);

// One thing that is not as it should be, the numbers behind it, and what would help.
struct Diagnostic {
  bool rejects = false;
  std::string what;
  std::string to_do;
};

// How a view sees the board.
struct ViewGeometry {
  bool used = false;
  double tilt_rad = 0.0;       // of the board against the picture's plane, 0 ... pi/2
  double direction_rad = 0.0;  // towards which side it leans away: 0 right, pi/2 down
  double distance_m = 0.0;     // to the middle of the board
};

struct Assessment {
  Verdict verdict = Verdict::Rejected;
  std::vector<Diagnostic> diagnostics;
  double held_out_rms_px = 0.0;  // of views that the solver was not shown; NaN when there are too few
  int folds = 0;
  Grid grid;
  std::vector<int> corners;       // by cell
  std::vector<double> sigma_px;   // by cell, see projected_sigma_px()
  double covered = 0.0;           // share of the cells with corners
  double sigma_typical_px = 0.0;  // median over the cells with corners
  double sigma_worst_px = 0.0;    // over all cells
  std::vector<ViewGeometry> views;
  double largest_tilt_rad = 0.0;
  double normals_spread_rad = 0.0;  // largest angle between the board's normals in the camera's frame
  double edge_width_px = 0.0;       // median over the views

  // "rejected: focal length known to 2.4 % only ...", one line; the first diagnostic decides.
  std::string sentence(const Solution& solution) const;
};

// Everything that speaks for and against a solution. Gates: see the source; docs/calibration.md lists them.
Assessment assess(const Board& board, const Observations& observations, const Solution& solution,
                  const SolveOptions& options);

}  // namespace calib
