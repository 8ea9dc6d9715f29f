#pragma once

#include <filesystem>

#include "render/base/image.h"

namespace render {

// Files appear whole: written beside the final name, then renamed. All throw std::runtime_error that names the file and
// what is wrong with it. Values are kept as they are: the unit is the caller's. What is read is finite: values that are
// not are replaced with a warning (finite_pixels.h). Sizes are bounded, and by what the file can hold
// (picture_limits.h).

// OpenEXR. Written with 32-bit floats R, G, B. Read: half, float or integer channels, R G B (A ignored), luminance
// alone (Y, grey) or luminance and chroma (Y RY BY); other primaries are brought to Rec. 709. The picture is the
// display window; outside of the data window it is black, and what the data window has beyond it is cut off.
void write_exr(const std::filesystem::path& path, const LinearImage& image);
LinearImage read_exr(const std::filesystem::path& path);

// Radiance RGBE, run-length coded. A channel is off by at most 1/256 of the pixel's largest one; values must be finite
// and not negative (negative ones are written as 0). Read: flat or run-length coded; EXPOSURE and COLORCORR are taken
// out again, PRIMARIES brought to Rec. 709.
void write_hdr(const std::filesystem::path& path, const LinearImage& image);
LinearImage read_hdr(const std::filesystem::path& path);

// PNG, 8 bits a channel; alpha is written only where some pixel is not opaque.
void write_png(const std::filesystem::path& path, const Image& image);
Image read_png(const std::filesystem::path& path);

}  // namespace render
