#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/live/latest.h"
#include "ar/capture/live/live_source.h"

namespace app {

using LiveClock = std::chrono::steady_clock;

// A frame with the instant at which the program got it, which is later than when it was taken (frame.time_s).
struct ArrivedFrame {
  ar::Frame frame;
  LiveClock::time_point arrived;
};

// What became of what a camera gave, so far.
struct FeedCounts {
  std::int64_t captured = 0;  // frames that the program got
  std::int64_t stale = 0;     // of these, dropped for a newer one
  std::int64_t missed = 0;    // lost before the program could get them
  std::int64_t damaged = 0;
  std::int64_t losses = 0;         // times that the device went away
  std::int64_t reconnections = 0;  // times that it came back
};

struct FeedOptions {
  // How long a lost device is waited for, s; unset: without end; 0: not at all.
  std::optional<double> reconnect_for_s;
  std::chrono::milliseconds first_wait{250};  // before it is sought again; doubled each time up to
  std::chrono::milliseconds longest_wait{4000};
};

// Reads a live source on a thread of its own, always the newest frame, and finds the device again after it was lost.
class LiveFeed {
 public:
  using Opener = std::function<std::unique_ptr<ar::LiveSource>(const std::string& specification)>;

  // `source` is open; `reopen` opens what its identity() says, and throws ar::InputError while that is not there. A
  // device that comes back with pictures of another format counts as not there.
  LiveFeed(std::unique_ptr<ar::LiveSource> source, Opener reopen, FeedOptions options);
  ~LiveFeed();
  LiveFeed(const LiveFeed&) = delete;
  LiveFeed& operator=(const LiveFeed&) = delete;

  const ar::SourceInfo& info() const { return info_; }
  void start();
  void stop();

  // The newest frame, waiting at most `patience`. Used by one thread.
  std::optional<ArrivedFrame> take(std::chrono::milliseconds patience) { return frames_.take(patience); }
  // Nothing more will come: the file is over, or the device is lost for good. Rethrows what went wrong in the thread.
  bool over() const;
  // Why there is no device just now, for people; empty while there is one.
  std::string lost() const;
  // The device is lost for good.
  bool gave_up() const { return gave_up_; }
  FeedCounts counts() const;

 private:
  void run(const std::stop_token& stop);
  void read_all(const std::stop_token& stop);
  void keep(ar::Frame frame);
  bool reconnect(const std::stop_token& stop, const std::string& reason);
  void note_damage();
  void set_lost(const std::string& reason);

  std::unique_ptr<ar::LiveSource> source_;  // of the thread once it runs
  const Opener reopen_;
  const FeedOptions options_;
  const ar::SourceInfo info_;
  Latest<ArrivedFrame> frames_;

  mutable std::mutex mutex_;  // of what follows
  FeedCounts counts_;
  ar::LiveCounts before_;  // of the sources that are gone
  std::string lost_;
  std::exception_ptr failure_;

  std::atomic<bool> gave_up_ = false;
  std::int64_t next_index_ = 0;
  std::int64_t notified_damaged_ = 0;
  LiveClock::time_point notified_at_;
  std::jthread thread_;
};

}  // namespace app
