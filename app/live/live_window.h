#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/live/live_frame.h"
#include "app/live/live_settings.h"

namespace app {

// A tag of the map, or one that was seen without being in it.
struct TagState {
  int id = 0;
  std::optional<std::array<double, 3>> position_m;  // in world, by the map
  bool seen = false;
  std::optional<double> rms_px;  // how far its corners lie from where pose and map put them; where both are known
};

// What the window tells of the frame that it shows.
struct WindowFacts {
  std::string state;  // "tracking", "lost", ...
  std::string lost;   // why there is no camera just now; empty while there is one
  double track_ms = 0.0;
  double draw_ms = 0.0;
  double latency_ms = 0.0;
  double per_second = 0.0;
  std::int64_t dropped = 0;
  std::string quality;
  double exposure = 0.0;  // display-linear per cd/m2
  double elapsed_s = 0.0;
  std::vector<TagState> tags;  // by id
};

// What the user did in it.
struct WindowRequests {
  bool close = false;
  bool still = false;
  bool save = false;
  std::optional<LiveSettings> settings;  // changed ones
};

// The window of `live`, with the panel over the picture. See DesktopWindow: its GL context is current on the calling
// thread after each call.
class LiveWindow {
 public:
  // Throws std::runtime_error that says what to do where there is no display or no GL for it.
  LiveWindow(const ar::PixelFormat& format, const std::string& title, bool full_screen);
  ~LiveWindow();
  LiveWindow(const LiveWindow&) = delete;
  LiveWindow& operator=(const LiveWindow&) = delete;

  // Shows the picture, waits for the screen, and tells what the user did meanwhile. `settings` are what the panel
  // shows.
  WindowRequests show(const ShownPicture& shown, const WindowFacts& facts, const LiveSettings& settings);
  // A line over the picture for some seconds.
  void say(const std::string& message);
  // Time between handing the last picture over and the screen taking it, ms.
  double swap_ms() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
