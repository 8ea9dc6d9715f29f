#pragma once

#include <array>

#include "app/live/live_window.h"

namespace app {

// What the panel shows and changes. Between the gui's begin_frame() and draw().
class WindowPanel {
 public:
  // A frame's times, for the graphs.
  void note(const WindowFacts& facts, double show_ms);
  // True when something was changed in `settings`.
  bool draw(const WindowFacts& facts, LiveSettings& settings, WindowRequests& requests);
  static void draw_help();

 private:
  static constexpr std::size_t kGraphFrames = 240;
  struct Graph {
    const char* name;
    std::array<float, kGraphFrames> ms{};
  };

  void draw_graphs() const;

  std::array<Graph, 4> graphs_{{{"track", {}}, {"draw", {}}, {"show", {}}, {"latency", {}}}};
  std::size_t at_ = 0;
};

}  // namespace app
