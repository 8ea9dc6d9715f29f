#include "app/process/frame_reader.h"

#include <algorithm>

#include "app/pipeline/interrupt.h"

namespace app {

FrameReader::FrameReader(ar::FrameSource& source, const FrameRange& range) : source_(source), range_(range) {}

std::vector<const ar::Frame*> FrameReader::peek(std::size_t count) {
  while (ahead_.size() < count) {
    auto frame = read();
    if (!frame) break;
    ahead_.push_back(std::move(*frame));
  }
  std::vector<const ar::Frame*> frames;
  for (const ar::Frame& frame : ahead_) frames.push_back(&frame);
  return frames;
}

std::optional<ar::Frame> FrameReader::next() {
  if (InterruptGuard::requested()) return std::nullopt;
  if (ahead_.empty()) return read();
  std::optional<ar::Frame> frame(std::move(ahead_.front()));
  ahead_.pop_front();
  return frame;
}

std::optional<std::int64_t> FrameReader::expected() const {
  const auto& count = source_.info().frame_count;
  if (!count) return std::nullopt;
  return std::max<std::int64_t>(0, std::min(*count, range_.end) - range_.first);
}

std::optional<ar::Frame> FrameReader::read() {
  while (!ended_ && !InterruptGuard::requested()) {
    auto frame = source_.next();
    if (!frame || frame->index >= range_.end) break;
    if (!start_s_) start_s_ = frame->time_s;
    if (frame->index >= range_.first) return frame;
  }
  ended_ = true;
  return std::nullopt;
}

}  // namespace app
