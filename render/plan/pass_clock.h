#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/gl/timer.h"
#include "render/plan/renderer.h"

namespace render {

// Times the passes of a frame, when it is on. Off, it costs nothing.
class PassClock {
 public:
  void enable(bool on) { on_ = on; }
  void begin_frame();
  // Runs `pass` and notes its time under `name`.
  template <typename F>
  void time(const std::string& name, F&& pass) {
    start(name);
    pass();
    stop(name);
  }
  const std::vector<PassTime>& times() const { return times_; }

 private:
  void start(const std::string& name);
  void stop(const std::string& name);

  bool on_ = false;
  double started_s_ = 0.0;
  double started_cpu_s_ = 0.0;
  std::map<std::string, gl::Timer> timers_;
  std::vector<PassTime> times_;
};

}  // namespace render
