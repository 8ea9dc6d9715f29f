#pragma once

#include <string>

#include "app/calibration/summary.h"

namespace app {

// SVG elements of a calibration's report. The first four show the picture, `width` px of the page across.
std::string coverage_plot(const Calibration& c, int width);     // corners by view; crosses are outliers
std::string residual_plot(const Calibration& c, int width);     // arrows of the residuals, enlarged
std::string uncertainty_plot(const Calibration& c, int width);  // projected standard deviation by cell
std::string distortion_plot(const Calibration& c, int width);   // where the lens takes a pinhole's grid
std::string scatter_plot(const Calibration& c);                 // residuals about zero
std::string tilt_plot(const Calibration& c);                    // how the board leans in each view
std::string view_bars(const Calibration& c);                    // RMS of each view

}  // namespace app
