#pragma once

#include <gtest/gtest.h>

#include <string>

#include "render/scene/image_io.h"

namespace golden {

// How two linear pictures differ.
struct LinearDifference {
  double relative_rmse = 0.0;  // root of sum of squared differences over sum of squared reference
  double max_relative = 0.0;   // largest |difference| over the reference's mean
};
LinearDifference compare_linear(const render::LinearImage& found, const render::LinearImage& reference);

// How two displayed pictures differ.
struct DisplayDifference {
  int max_steps = 0;        // largest difference of a channel
  double mean_steps = 0.0;  // of all channels
  double psnr_db = 0.0;     // infinite where equal
};
DisplayDifference compare_display(const render::Image& found, const render::Image& reference);

// Passes when no channel differs by more than `max_steps`. Otherwise writes found, reference and their difference
// (amplified 16 times about grey) as PNGs into the build's folder golden-failures under `name`, and says where.
testing::AssertionResult same_display(const std::string& name, const render::Image& found,
                                      const render::Image& reference, int max_steps);

}  // namespace golden
