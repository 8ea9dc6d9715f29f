#include "app/pipeline/pipeline.h"

#include <chrono>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "app/pipeline/bounded_queue.h"
#include "render/base/median.h"

namespace app {
namespace {

// Adds the time until it goes out of scope to a stage.
class Stopwatch {
 public:
  explicit Stopwatch(StageTime& stage) : stage_(stage) {}
  ~Stopwatch() {
    const std::chrono::duration<float, std::milli> passed = std::chrono::steady_clock::now() - start_;
    stage_.frame_ms.push_back(passed.count());
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  StageTime& stage_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

template <typename Work>
auto timed(StageTime& stage, Work&& work) {
  const Stopwatch stopwatch(stage);
  return work();
}

class Run {
 public:
  Run(const Stages& stages, std::size_t depth) : stages_(stages), decoded_(depth), tracked_(depth), finished_(depth) {}

  std::vector<StageTime> go() {
    {
      const std::jthread decode([this] { guarded([this] { decode_all(); }); });
      const std::jthread track([this] { guarded([this] { track_all(); }); });
      const std::jthread encode([this] { guarded([this] { encode_all(); }); });
      guarded([this] { render_all(); });
    }
    if (failure_) std::rethrow_exception(failure_);
    return {times_[0], times_[1], times_[2], times_[3]};
  }

 private:
  template <typename Body>
  void guarded(Body&& body) {
    try {
      body();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      decoded_.abort();
      tracked_.abort();
      finished_.abort();
    }
  }

  void decode_all() {
    while (auto frame = timed(times_[0], [this] { return stages_.decode(); })) {
      if (!decoded_.push(std::move(*frame))) return;
    }
    times_[0].frame_ms.pop_back();  // the call that found the end decoded nothing
    decoded_.close();
  }

  void track_all() {
    while (auto frame = decoded_.pop()) {
      if (!tracked_.push(timed(times_[1], [&] { return stages_.track(std::move(*frame)); }))) return;
    }
    tracked_.close();
  }

  void render_all() {
    while (auto frame = tracked_.pop()) {
      if (!finished_.push(timed(times_[2], [&] { return stages_.render(std::move(*frame)); }))) return;
    }
    finished_.close();
  }

  void encode_all() {
    while (auto frame = finished_.pop()) {
      timed(times_[3], [&] { stages_.encode(std::move(*frame)); });
    }
  }

  const Stages& stages_;
  BoundedQueue<ar::Frame> decoded_;
  BoundedQueue<TrackedFrame> tracked_;
  BoundedQueue<FinishedFrame> finished_;
  StageTime times_[4] = {{"decode", {}}, {"track", {}}, {"render", {}}, {"encode", {}}};
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

double StageTime::busy_s() const {
  return std::accumulate(frame_ms.begin(), frame_ms.end(), 0.0) / 1000.0;
}

double StageTime::median_ms() const {
  return render::median(frame_ms, 0.0);
}

std::vector<StageTime> run_pipeline(const Stages& stages, std::size_t depth) {
  return Run(stages, depth).go();
}

}  // namespace app
