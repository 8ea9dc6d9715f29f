#pragma once

#include <string>

#include "ar/capture/frame.h"

namespace ar {

// How a stream names its colours, in the code points of ITU-T H.273 (2 or 0: unspecified), which containers, codecs
// and FFmpeg's AVCOL_* share. Kept beside ColorInfo so that what goes out is tagged exactly as what came in.
struct ColorTags {
  int primaries = 2;
  int transfer = 2;
  int matrix = 2;
  int range = 0;   // FFmpeg's AVColorRange: 0 unspecified, 1 limited, 2 full
  int siting = 0;  // FFmpeg's AVChromaLocation: 0 unspecified, 1 left, 2 center, 3 top left
  bool operator==(const ColorTags&) const = default;
};

// Unknown where the tag is unspecified or is one that nothing here renders (YCgCo, log transfers, ...).
ColorInfo color_from_tags(const ColorTags& tags);
// The plainest tags that read back as `color`.
ColorTags tags_from_color(const ColorInfo& color);

// Replaces every Unknown in `color` by what such pictures usually are, and nothing else: the one place that guesses.
// `width` and `height` in pixels, in either order (turned pictures are the same pictures). Follows libplacebo:
// RGB is full-range sRGB; wide-gamut primaries imply their matrix and the reverse; full-range BT.601 with nothing else
// said is JPEG (JFIF: sRGB); otherwise high definition (long side >= 1280 or short side > 576) is BT.709, 576 lines are
// BT.601 with 625-line primaries, 480 and 486 with 525-line ones; YCbCr is limited range and left-sited.
ColorInfo guess_color(const ColorInfo& color, int width, int height);

// "matrix BT.709, range limited": the fields that `guessed` has and `tagged` lacks, for the log; empty when none.
std::string describe_guess(const ColorInfo& tagged, const ColorInfo& guessed);

}  // namespace ar
