#include "ar/capture/live/file_live_source.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "ar/capture/file/open_source.h"
#include "ar/error.h"

namespace ar {
namespace {

using Clock = std::chrono::steady_clock;

// Frames that wait for a reader; as many again are decoded before they are due, so that a slow one is not late.
constexpr std::size_t kWaiting = 4;
constexpr std::size_t kAhead = 4;

class FileLiveSource : public LiveSource {
 public:
  explicit FileLiveSource(const std::filesystem::path& clip)
      : identity_("file:" + clip.string()), source_(open_source(clip.string())), info_(source_->info()) {
    decoder_ = std::jthread([this](const std::stop_token& stop) { decode(stop); });
  }

  ~FileLiveSource() override {
    decoder_.request_stop();
    changed_.notify_all();
  }
  FileLiveSource(const FileLiveSource&) = delete;
  FileLiveSource& operator=(const FileLiveSource&) = delete;

  const SourceInfo& info() const override { return info_; }
  std::string identity() const override { return identity_; }

  LiveCounts counts() const override {
    const std::lock_guard lock(mutex_);
    return {.missed = missed_, .damaged = damaged_};
  }

  LiveRead read(std::chrono::milliseconds patience) override {
    const Clock::time_point until = Clock::now() + patience;
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, until, [this] { return !decoded_.empty() || ended_; });
    if (decoded_.empty()) return ended_ ? ending() : LiveRead{};
    if (!start_) {
      start_ = Clock::now();
      first_time_s_ = decoded_.front().time_s;
      changed_.notify_all();
    }
    if (due(decoded_.front()) > until) {
      changed_.wait_until(lock, until, [] { return false; });
      return {};
    }
    while (Clock::now() < due(decoded_.front())) changed_.wait_until(lock, due(decoded_.front()));
    Frame frame = std::move(decoded_.front());
    decoded_.pop_front();
    changed_.notify_all();
    frame.time_s = std::chrono::duration<double>(due(frame).time_since_epoch()).count();
    return {.status = LiveStatus::Frame, .frame = std::move(frame), .reason = ""};
  }

 private:
  Clock::time_point due(const Frame& frame) const {
    const std::chrono::duration<double> since_start(frame.time_s - first_time_s_);
    return *start_ + std::chrono::duration_cast<Clock::duration>(since_start);
  }

  LiveRead ending() const {
    if (!failure_.empty()) throw InputError(failure_);
    return {.status = LiveStatus::End, .frame = std::nullopt, .reason = ""};
  }

  // The oldest that nobody has read in time are lost, as when a driver has no free buffer.
  bool make_room() {
    std::size_t waiting = 0;
    const Clock::time_point now = Clock::now();
    while (start_ && waiting < decoded_.size() && due(decoded_[waiting]) <= now) ++waiting;
    for (; waiting > kWaiting; --waiting, ++missed_) decoded_.pop_front();
    return decoded_.size() < kWaiting + kAhead;
  }

  void decode(const std::stop_token& stop) {
    try {
      while (auto frame = source_->next()) {
        std::unique_lock lock(mutex_);
        damaged_ = source_->damaged();
        while (!stop.stop_requested() && !make_room()) {
          changed_.wait_for(lock, std::chrono::milliseconds(10));
        }
        if (stop.stop_requested()) return;
        decoded_.push_back(std::move(*frame));
        changed_.notify_all();
      }
    } catch (const InputError& error) {
      const std::lock_guard lock(mutex_);
      failure_ = error.what();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  const std::string identity_;
  std::unique_ptr<FrameSource> source_;  // of the decoder's thread
  const SourceInfo info_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Frame> decoded_;
  std::optional<Clock::time_point> start_;
  double first_time_s_ = 0.0;
  std::int64_t missed_ = 0;
  std::int64_t damaged_ = 0;
  bool ended_ = false;
  std::string failure_;
  std::jthread decoder_;
};

}  // namespace

std::unique_ptr<LiveSource> open_file_live_source(const std::filesystem::path& clip) {
  return std::make_unique<FileLiveSource>(clip);
}

}  // namespace ar
