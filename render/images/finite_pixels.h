#pragma once

#include <cstddef>
#include <string>

#include "render/base/image.h"

namespace render {

// Every reader of floating-point pictures passes what it decoded through here, before anything computes with it.
//
// Values that nothing can be computed from are replaced, each channel on its own: too large ones (+infinity, above
// 1e30) by the picture's largest value, at least 65504, the largest half float: a sun's disc overflowed there; NaN and
// what is below -1e30 by the mean of the valid values among the eight pixels around it, 0 where there are none.
// Negative values of ordinary size stay: colours outside of Rec. 709's gamut have them.
// Returns how many pixels were touched; logs a warning that names `file` and that number. Throws std::runtime_error,
// without the file's name, when the picture holds no valid value at all.
std::size_t replace_invalid_values(LinearImage& image, const std::string& file);

}  // namespace render
