#include "app/pipeline/interrupt.h"

#include <atomic>
#include <csignal>

namespace app {
namespace {

std::atomic<bool> interrupt_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void remember_interrupt(int) {
  interrupt_requested = true;
}

void set_handler(int signal_number, void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupt_requested = false;
  for (const int signal_number : {SIGINT, SIGTERM}) {
    // RESETHAND: the second signal meets the default action. RESTART: file reads and writes go on.
    set_handler(signal_number, remember_interrupt, static_cast<int>(SA_RESETHAND) | SA_RESTART);
  }
}

InterruptGuard::~InterruptGuard() {
  for (const int signal_number : {SIGINT, SIGTERM}) set_handler(signal_number, SIG_DFL, 0);
}

bool InterruptGuard::requested() {
  return interrupt_requested;
}

}  // namespace app
