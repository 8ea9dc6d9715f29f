#include "app/live/recorder.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr std::size_t kWaiting = 8;
// A clock that all usual frame rates divide.
constexpr int kTicksPerSecond = 90'000;
// Between two pictures: Matroska counts in milliseconds. A held picture is as old as the one before it.
constexpr std::int64_t kLeastStep = kTicksPerSecond / 1000;

// What a camera gives has neither sound nor metadata to copy, and a clock of its own.
ar::SourceInfo recorded_source(ar::SourceInfo source) {
  source.path.clear();
  source.tags.reset();
  source.time_base = {1, kTicksPerSecond};
  return source;
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& path, const ar::SourceInfo& source, ar::VideoSinkOptions options)
    : waiting_(kWaiting) {
  options.live = true;
  sink_ = ar::make_file_sink(path, recorded_source(source), options);
  thread_ = std::jthread([this] { run(); });
}

Recorder::~Recorder() {
  waiting_.abort();
}

void Recorder::rethrow() const {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

void Recorder::show(const ShownPicture& shown) {
  rethrow();
  // A held picture lasts as long as it lasts: once is enough.
  if (shown.held && holding_) return;
  holding_ = shown.held;
  if (!waiting_.try_push(shown)) ++left_out_;
}

void Recorder::finish() {
  waiting_.close();
  if (thread_.joinable()) thread_.join();
  rethrow();
  sink_->finish();
}

void Recorder::run() {
  try {
    std::int64_t last = -kLeastStep;
    while (auto shown = waiting_.pop()) {
      if (!start_s_) start_s_ = shown->time_s;
      const std::int64_t pts = std::llround((shown->time_s - *start_s_) * kTicksPerSecond);
      last = std::max(last + kLeastStep, pts);
      sink_->write(std::move(shown->picture), last);
      ++recorded_;
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    waiting_.abort();
  }
}

}  // namespace app
