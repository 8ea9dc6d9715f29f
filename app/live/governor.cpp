#include "app/live/governor.h"

#include <algorithm>

namespace app {
namespace {

// The first frames at a level may build what later ones find ready.
constexpr int kSettling = 3;
constexpr int kBeforeDown = 6;
constexpr int kBeforeUp = 60;
constexpr int kLongestPatience = 3600;
// A level up costs up to twice as much; it must fit.
constexpr double kRoomToGoUp = 0.45;
constexpr double kNewest = 0.2;

}  // namespace

std::vector<render::Quality> quality_presets(const render::Quality& asked) {
  std::vector<render::Quality> presets{asked};
  render::Quality next = asked;
  next.anti_alias = false;
  next.quick_shadows = true;
  presets.push_back(next);
  for (const double part : {0.7, 0.5, 0.35, 0.25}) {
    next.render_scale = asked.render_scale * part;
    presets.push_back(next);
  }
  return presets;
}

Governor::Governor(std::size_t levels, double target_ms, std::size_t level)
    : levels_(levels), target_ms_(target_ms), level_(level), patience_(kBeforeUp) {}

void Governor::set_target_ms(double target_ms) {
  target_ms_ = target_ms;
  frames_ = 0;
  patience_ = kBeforeUp;
  if (target_ms_ <= 0.0) level_ = 0;
}

bool Governor::go(std::size_t level) {
  went_up_ = level < level_;
  level_ = level;
  frames_ = 0;
  ++changes_;
  return true;
}

bool Governor::add(double ms) {
  if (target_ms_ <= 0.0) return false;
  if (++frames_ <= kSettling) {
    recent_ms_ = ms;
    return false;
  }
  recent_ms_ += kNewest * (ms - recent_ms_);
  if (recent_ms_ > target_ms_ && frames_ >= kBeforeDown && level_ + 1 < levels_) {
    if (went_up_) patience_ = std::min(2 * patience_, kLongestPatience);
    return go(level_ + 1);
  }
  if (recent_ms_ < kRoomToGoUp * target_ms_ && frames_ >= patience_ && level_ > 0) return go(level_ - 1);
  return false;
}

}  // namespace app
