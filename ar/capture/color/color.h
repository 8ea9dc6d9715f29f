#pragma once

#include <string>

#include "ar/capture/frame.h"

namespace ar {

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
