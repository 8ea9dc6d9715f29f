#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "calib/boards/board.h"
#include "calib/boards/observation.h"

namespace calib {

// What a view looks like: place, size and tilt, so scaled that 1 is about as different as views get.
using ViewDescriptor = std::array<double, 5>;

// `picture_px`: the picture's longer side. The view has 4 points or more.
ViewDescriptor descriptor_of(const Board& board, const Observation& view, double picture_px);
double distance(const ViewDescriptor& a, const ViewDescriptor& b);

// Median shift, px, of the points that two observations have in common; infinite where there are none.
double median_shift_px(const Observation& a, const Observation& b);

}  // namespace calib
