#pragma once

namespace app {

// While it lives, the first SIGINT or SIGTERM only sets a flag, so that the output can be finalised; a second one ends
// the process at once. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  // From any thread.
  static bool requested();
};

}  // namespace app
