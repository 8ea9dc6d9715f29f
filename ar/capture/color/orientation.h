#pragma once

#include <cstdint>
#include <string>

#include "ar/capture/frame.h"

namespace ar {

// One of the eight ways a stored picture can lie: how it must be turned to stand upright.
struct Orientation {
  bool transpose = false;  // first: rows become columns
  bool flip_x = false;     // then: left and right change places
  bool flip_y = false;     // then: top and bottom change places
  bool operator==(const Orientation&) const = default;

  bool upright() const { return !transpose && !flip_x && !flip_y; }
  // Clockwise turn in degrees: 0, 90, 180 or 270; of a mirrored picture, the turn that follows the mirroring.
  int rotation_deg() const;
  // The filters of libavfilter that do it ("transpose=clock"), or an empty string.
  std::string filters() const;
};

// From a display matrix as MP4 and FFmpeg write it (ISO 14496-12, 16.16 fixed point: x' = m[0] x + m[3] y, y' = m[1] x
// + m[4] y). Angles between the quarter turns go to the nearest one; `exact` tells when that happened.
Orientation orientation_from_matrix(const std::int32_t matrix[9], bool* exact = nullptr);

// Where the chroma samples lie after the turn. A siting that no tag can name (left-sited pictures mirrored become
// right-sited) goes to Center, which is half a luma sample off at most.
ChromaSiting siting_after(const Orientation& orientation, ChromaSiting siting);

}  // namespace ar
