#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "app/live/live_frame.h"
#include "app/pipeline/bounded_queue.h"
#include "ar/capture/source.h"

namespace app {

// Records what is shown, on a thread of its own. Where the encoder cannot keep up, pictures are left out of the
// recording and counted: what is shown never waits.
class Recorder : public LiveOutput {
 public:
  // Throws std::runtime_error as ar::make_file_sink() does.
  Recorder(const std::filesystem::path& path, const ar::SourceInfo& source, ar::VideoSinkOptions options);
  ~Recorder() override;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Throws what went wrong in the thread (disk full).
  void show(const ShownPicture& shown) override;
  // Writes what is waiting and finalises.
  void finish() override;

  std::int64_t recorded() const { return recorded_; }
  std::int64_t left_out() const { return left_out_; }

 private:
  void run();
  void rethrow() const;

  std::unique_ptr<ar::FrameSink> sink_;  // of the thread
  BoundedQueue<ShownPicture> waiting_;
  std::optional<double> start_s_;
  bool holding_ = false;
  std::atomic<std::int64_t> recorded_ = 0;
  std::atomic<std::int64_t> left_out_ = 0;
  mutable std::mutex mutex_;
  std::exception_ptr failure_;
  std::jthread thread_;
};

}  // namespace app
