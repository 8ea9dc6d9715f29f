#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "ar/capture/frame.h"

namespace app {

// Pixels of a photograph, OpenCV's count.
struct ShadowPixels {
  cv::Point2d base;
  cv::Point2d tip;
};

// Shows a photograph and has the foot of a vertical edge and a point of its shadow clicked in it, with a magnifier
// under the cursor. Backspace or Escape takes a click back, Enter accepts both. Nothing when the window is closed.
// Throws std::runtime_error where there is no display, saying which flags to give instead.
std::optional<ShadowPixels> click_shadow(const ar::Frame& photo, const std::string& name);

}  // namespace app
