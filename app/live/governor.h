#pragma once

#include <cstddef>
#include <vector>

#include "render/plan/plan.h"

namespace app {

// What is given up first when there is too little time: settings from what was asked for to the cheapest that still
// shows all there is. The first is `asked`.
std::vector<render::Quality> quality_presets(const render::Quality& asked);

// Keeps the time that a frame's drawing takes below a target by choosing among settings, cheapest last. Goes down as
// soon as recent frames are too slow, up again only after a while with time to spare, and waits twice as long after
// each time that going up proved wrong, so that it does not swing.
class Governor {
 public:
  // `levels` >= 1; target_ms 0: always level 0.
  Governor(std::size_t levels, double target_ms, std::size_t level = 0);

  std::size_t level() const { return level_; }
  double target_ms() const { return target_ms_; }
  void set_target_ms(double target_ms);
  // Time of one frame at the current level. True when the level changed.
  bool add(double ms);
  std::size_t changes() const { return changes_; }

 private:
  bool go(std::size_t level);

  std::size_t levels_;
  double target_ms_;
  std::size_t level_;
  std::size_t changes_ = 0;
  double recent_ms_ = 0.0;  // mean of the recent frames at this level, newer ones counting more
  int frames_ = 0;          // at this level
  int patience_ = 0;        // frames with time to spare before going up
  bool went_up_ = false;    // the last change was upwards
};

}  // namespace app
