#include "render/plan/pass_clock.h"

#include <GLES3/gl31.h>

#include <chrono>
#include <ctime>

#include "render/gl/extensions.h"

namespace render {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_s() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

}  // namespace

void PassClock::begin_frame() {
  times_.clear();
}

void PassClock::start(const std::string& name) {
  if (!on_) return;
  glFinish();
  started_s_ = now_s();
  started_cpu_s_ = cpu_s();
  timers_[name].start();
}

void PassClock::stop(const std::string& name) {
  if (!on_) return;
  gl::Timer& timer = timers_[name];
  timer.stop();
  glFinish();
  // A software rasteriser draws when it is flushed: its timer tells a hundredth to a tenth of what a pass takes that
  // draws into the framebuffer which the last one drew into.
  const double gpu_ms = gl::extensions().software ? 0.0 : timer.milliseconds().value_or(0.0);
  times_.push_back({name, gpu_ms, (now_s() - started_s_) * 1e3, (cpu_s() - started_cpu_s_) * 1e3});
}

}  // namespace render
