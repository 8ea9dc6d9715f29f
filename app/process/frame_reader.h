#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "app/options/frame_range.h"
#include "ar/capture/source.h"

namespace app {

// The frames of a source within a range, until an interrupt is requested. The first ones can be looked at before.
class FrameReader {
 public:
  FrameReader(ar::FrameSource& source, const FrameRange& range);

  // The next `count` frames, or fewer at the end, without consuming them.
  std::vector<const ar::Frame*> peek(std::size_t count);
  std::optional<ar::Frame> next();

  // Time of the source's first frame, which is also that of the recording; 0 before any frame was read.
  double start_s() const { return start_s_.value_or(0.0); }
  // How many frames will come, as far as is known.
  std::optional<std::int64_t> expected() const;

 private:
  std::optional<ar::Frame> read();

  ar::FrameSource& source_;
  const FrameRange range_;
  std::deque<ar::Frame> ahead_;
  std::optional<double> start_s_;
  bool ended_ = false;
};

}  // namespace app
