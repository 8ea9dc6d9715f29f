#pragma once

extern "C" {
#include <libavutil/pixfmt.h>
}

#include "ar/capture/frame.h"

namespace ar {

// Whether frames of this format are handed on as they lie: planar 4:2:0, 4:2:2, 4:4:4 or G, B, R of 8 or 10 bits.
bool is_native(AVPixelFormat format);

// The native format that holds `format` with the least loss: RGB and palettes become planar RGB, everything else planar
// YCbCr with at least its chroma resolution where 4:2:2 or 4:4:4 can give it; more than 8 bits become 10. Alpha is
// dropped. Throws std::invalid_argument for formats that cannot be held (floating point, XYZ, Bayer, hardware).
AVPixelFormat nearest_native(AVPixelFormat format);

// Fills bit_depth and chroma of a native format.
void describe_native(AVPixelFormat native, PixelFormat& out);

// The native format of frames that are described so; planar RGB where the matrix is Rgb.
AVPixelFormat native_format(const PixelFormat& format);

}  // namespace ar
