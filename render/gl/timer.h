#pragma once

#include <GLES3/gl31.h>

#include <optional>
#include <utility>

namespace render::gl {

// GPU time between start() and stop(), by EXT_disjoint_timer_query. Move-only. Only one may run at a time.
class Timer {
 public:
  Timer() = default;
  Timer(Timer&& other) noexcept { *this = std::move(other); }
  Timer& operator=(Timer&& other) noexcept;
  ~Timer();

  void start();
  void stop();
  // Waits for the GPU. Absent where the driver has no timer queries or nothing was timed.
  std::optional<double> milliseconds() const;

 private:
  GLuint id_ = 0;
  bool timed_ = false;
};

}  // namespace render::gl
