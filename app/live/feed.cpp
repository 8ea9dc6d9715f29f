#include "app/live/feed.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "ar/error.h"

namespace app {
namespace {

constexpr std::chrono::milliseconds kPatience{100};

// Sleeps in short steps, so that a stop takes effect at once.
void sleep_until(LiveClock::time_point until, const std::stop_token& stop) {
  while (!stop.stop_requested() && LiveClock::now() < until) {
    std::this_thread::sleep_until(std::min(until, LiveClock::now() + std::chrono::milliseconds(20)));
  }
}

LiveClock::time_point giving_up_after(LiveClock::time_point since, const std::optional<double>& wait_s) {
  if (!wait_s) return LiveClock::time_point::max();
  return since + std::chrono::duration_cast<LiveClock::duration>(std::chrono::duration<double>(*wait_s));
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

LiveFeed::LiveFeed(std::unique_ptr<ar::LiveSource> source, Opener reopen, FeedOptions options)
    : source_(std::move(source)), reopen_(std::move(reopen)), options_(options), info_(source_->info()) {}

LiveFeed::~LiveFeed() {
  stop();
}

void LiveFeed::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

void LiveFeed::stop() {
  thread_ = {};
}

bool LiveFeed::over() const {
  if (!frames_.over()) return false;
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  return true;
}

std::string LiveFeed::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

void LiveFeed::set_lost(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  lost_ = reason;
}

FeedCounts LiveFeed::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void LiveFeed::run(const std::stop_token& stop) {
  try {
    read_all(stop);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
  }
  frames_.close();
}

void LiveFeed::read_all(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    ar::LiveRead read = source_->read(kPatience);
    note_damage();
    if (read.status == ar::LiveStatus::End) return;
    if (read.status == ar::LiveStatus::Lost && !reconnect(stop, read.reason)) return;
    if (read.frame) keep(std::move(*read.frame));
  }
}

void LiveFeed::keep(ar::Frame frame) {
  // A source counts from 0 each time it is opened.
  next_index_ = std::max(next_index_, frame.index);
  frame.index = next_index_++;
  const bool stale = frames_.put({std::move(frame), LiveClock::now()});
  const std::lock_guard lock(mutex_);
  ++counts_.captured;
  if (stale) ++counts_.stale;
}

// Damaged frames are told at most once a second.
void LiveFeed::note_damage() {
  const ar::LiveCounts now = source_->counts();
  const std::lock_guard lock(mutex_);
  counts_.missed = before_.missed + now.missed;
  counts_.damaged = before_.damaged + now.damaged;
  if (counts_.damaged == notified_damaged_ || LiveClock::now() - notified_at_ < std::chrono::seconds(1)) return;
  spdlog::warn("{}: {} damaged frames skipped", info_.name, counts_.damaged - notified_damaged_);
  notified_damaged_ = counts_.damaged;
  notified_at_ = LiveClock::now();
}

bool LiveFeed::reconnect(const std::stop_token& stop, const std::string& reason) {
  const std::string identity = source_->identity();
  source_.reset();  // let go of it, so that the device can be made anew
  {
    const std::lock_guard lock(mutex_);
    before_ = {.missed = counts_.missed, .damaged = counts_.damaged};
    ++counts_.losses;
    lost_ = reason;
  }
  const auto since = LiveClock::now();
  const auto until = giving_up_after(since, options_.reconnect_for_s);
  spdlog::warn("{}; the last picture is held", reason);
  std::chrono::milliseconds wait = options_.first_wait;
  while (!stop.stop_requested()) {
    if (LiveClock::now() >= until) {
      gave_up_ = true;
      return false;
    }
    sleep_until(std::min(until, LiveClock::now() + wait), stop);
    wait = std::min(2 * wait, options_.longest_wait);
    try {
      auto source = reopen_(identity);
      if (source->info().format != info_.format) {
        set_lost(fmt::format("{} came back with pictures of another kind", info_.name));
        continue;
      }
      source_ = std::move(source);
      const std::lock_guard lock(mutex_);
      ++counts_.reconnections;
      lost_.clear();
      spdlog::info("{}: back after {:.1f} s", info_.name,
                   std::chrono::duration<double>(LiveClock::now() - since).count());
      return true;
    } catch (const ar::InputError& error) {
      set_lost(first_line(error.what()));
    }
  }
  return false;
}

}  // namespace app
