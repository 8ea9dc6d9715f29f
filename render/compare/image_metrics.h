#pragma once

#include <optional>
#include <span>

#include "render/images/image_io.h"

namespace render {

// How far a linear picture is from the truth.
struct LinearError {
  double relative_rmse = 0.0;  // RMS of the differences over RMS of the truth
  double largest_relative =
      0.0;  // of any channel, relative to the truth there or to 1 % of its mean, whichever is more
};
LinearError linear_error(const LinearImage& test, const LinearImage& truth);

// How far a displayed picture is from the true one (docs/trade.md, "The measures").
struct DisplayError {
  double psnr_db = 0.0;    // of the codes of R', G' and B'; infinite where the pictures are equal
  double ssim = 1.0;       // mean, of luma [Wang, Bovik, Sheikh & Simoncelli 2004]: Gaussian window of 1.5 pixels
  double flip = 0.0;       // mean
  double share_off = 0.0;  // of the pixels, those with a channel off by more than 2 / 255
  std::optional<double> largest_at_edges;  // codes, within 2 pixels of a depth edge; absent where none is known

  bool lossless() const { return psnr_db >= 50.0 && ssim >= 0.997 && flip <= 0.006 && share_off <= 0.005; }
  bool good() const { return psnr_db >= 42.0 && flip <= 0.012; }
};
// `axis_distance_m`: metres along the camera's axis a pixel; empty: unknown. Neighbours whose distances differ by more
// than a tenth lie on an edge.
DisplayError display_error(const Image& test, const Image& truth, std::span<const float> axis_distance_m = {});

// The difference as a picture: mid grey where there is none, `gain` times the difference of the codes elsewhere.
Image difference_image(const Image& test, const Image& truth, double gain = 16.0);

}  // namespace render
