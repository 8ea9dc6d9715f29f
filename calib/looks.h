#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "calib/board.h"
#include "calib/sighting.h"

namespace calib {

// What a view looks like: place, size and tilt, so scaled that 1 is about as different as views get.
using Looks = std::array<double, 5>;

// `picture_px`: the picture's longer side. The view has 4 points or more.
Looks looks_of(const Board& board, const Sighting& view, double picture_px);
double distance(const Looks& a, const Looks& b);

// Median shift, px, of the points that two sightings have in common; infinite where there are none.
double median_shift_px(const Sighting& a, const Sighting& b);

}  // namespace calib
