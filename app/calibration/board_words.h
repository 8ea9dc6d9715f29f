#pragma once

#include <string>

#include "calib/boards/board.h"

namespace app {

// Whether it begins as a short form of a board does: "chessboard:", "charuco:", "aprilgrid:", "tag:".
bool is_short_form(const std::string& specification);

// Throws UsageError that says the form which was expected.
calib::Board read_short_form(const std::string& specification);

// "25mm", "2.5cm" or "0.025" (m) as metres; > 0. Throws UsageError.
double metres_from(const std::string& text);

}  // namespace app
