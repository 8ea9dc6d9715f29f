#include "app/pipeline/progress.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace app {
namespace {

constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kBarInterval{100};
constexpr std::chrono::seconds kLineInterval{5};

std::string minutes_and_seconds(double seconds) {
  const auto whole = std::llround(seconds);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string describe(std::int64_t done, const std::optional<std::int64_t>& total, double rate) {
  if (!total || *total < done) return fmt::format("{} frames, {:.1f} a second", done, rate);
  const double left_s = rate > 0.0 ? static_cast<double>(*total - done) / rate : 0.0;
  return fmt::format("{}/{} frames, {:.1f} a second, {} left", done, *total, rate, minutes_and_seconds(left_s));
}

std::string bar(std::int64_t done, std::int64_t total) {
  const auto full = static_cast<std::size_t>(std::clamp<std::int64_t>(done * kBarWidth / total, 0, kBarWidth));
  return fmt::format("[{:.<{}}] ", std::string(full, '#'), kBarWidth);
}

}  // namespace

Progress::Progress(std::optional<std::int64_t> total, bool quiet)
    : total_(total && *total > 0 ? total : std::nullopt), terminal_(isatty(STDERR_FILENO) == 1), quiet_(quiet) {
  // A message wipes the bar first; the next update draws it again below.
  if (terminal_ && !quiet_) spdlog::set_pattern("\r\x1b[K%^%l%$: %v");
}

Progress::~Progress() {
  if (!terminal_ || quiet_) return;
  std::fputs("\r\x1b[K", stderr);
  spdlog::set_pattern("%^%l%$: %v");
}

void Progress::update(std::int64_t done) {
  const auto now = Clock::now();
  if (quiet_ || now - last_ < (terminal_ ? Clock::duration(kBarInterval) : Clock::duration(kLineInterval))) return;
  last_ = now;
  const double passed_s = std::chrono::duration<double>(now - start_).count();
  draw(done, static_cast<double>(done) / passed_s);
}

void Progress::draw(std::int64_t done, double rate) const {
  if (!terminal_) {
    spdlog::info("{}", describe(done, total_, rate));
    return;
  }
  const std::string line = (total_ ? bar(done, *total_) : "") + describe(done, total_, rate);
  std::fputs(("\r" + line + "\x1b[K").c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace app
