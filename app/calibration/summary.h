#pragma once

#include <string>
#include <vector>

#include "app/calibration/gather.h"
#include "calib/files/camera_file.h"
#include "calib/solve/cross_validation.h"
#include "calib/verdict/quality_gates.h"

namespace app {

// All that a calibration found, for its report.
struct Calibration {
  calib::Board board;
  Gathered gathered;
  calib::SolveOptions options;
  std::vector<calib::LensTrial> trials;  // of --lens auto
  calib::Solution solution;
  calib::Assessment assessment;
  std::string date;
};

// For people, on standard output.
std::string summary_text(const Calibration& calibration);

// One self-contained HTML page with inline SVG.
std::string report_html(const Calibration& calibration);

// What is written beside the numbers of the camera.
calib::CameraNote note_of(const Calibration& calibration);

// "left02.jpg: corner 12 by 3.41 px", worst first.
struct Outlier {
  std::string view;
  int point = 0;
  double off_px = 0.0;
};
std::vector<Outlier> outliers_of(const Calibration& calibration);

}  // namespace app
