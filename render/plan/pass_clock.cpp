#include "render/plan/pass_clock.h"

#include <GLES3/gl31.h>

#include <chrono>

namespace render {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void PassClock::begin_frame() {
  times_.clear();
}

void PassClock::start(const std::string& name) {
  if (!on_) return;
  glFinish();
  started_s_ = now_s();
  timers_[name].start();
}

void PassClock::stop(const std::string& name) {
  if (!on_) return;
  gl::Timer& timer = timers_[name];
  timer.stop();
  glFinish();
  times_.push_back({name, timer.milliseconds().value_or(0.0), (now_s() - started_s_) * 1e3});
}

}  // namespace render
