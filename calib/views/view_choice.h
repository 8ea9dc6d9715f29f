#pragma once

#include <cstddef>
#include <vector>

#include "calib/boards/board.h"
#include "calib/boards/observation.h"

namespace calib {

// How fast a board moves through the picture, px/s: the median over the points that this and the observation before or
// after it (whichever is closer in place) have in common. Infinite where there is no other.
std::vector<double> speeds_px_s(const std::vector<Observation>& in_order_of_time);

// Which frames of a recording to calibrate with: at most `most`, sharp and still, spread over places, distances and
// tilts. Indices into `frames`, rising. Frames with fewer than a third of the points of the fullest are left out.
std::vector<std::size_t> choose_views(const Board& board, const std::vector<Observation>& in_order_of_time, int width,
                                      int height, std::size_t most);

}  // namespace calib
