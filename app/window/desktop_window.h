#pragma once

#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ar/output/sink.h"

namespace app {

// A window on a desktop that shows pictures with Dear ImGui over them: what the windows of `live`, `calibrate --live`
// and `north` have in common. Everything that touches a display is behind this class. It has a GL context of its own,
// which is current on the calling thread after each call: make another current before using that one. One at a time, on
// the main thread.
class DesktopWindow {
 public:
  // As large as the pictures are; larger where they are tiny, as large as the screen allows where they are large.
  // Throws std::runtime_error where there is no display or no GL for it; `otherwise` ends the message with what can be
  // done without one.
  DesktopWindow(const ar::PixelFormat& format, const std::string& title, const std::string& otherwise);
  ~DesktopWindow();
  DesktopWindow(const DesktopWindow&) = delete;
  DesktopWindow& operator=(const DesktopWindow&) = delete;

  // Takes what the user did meanwhile. From here to show(), ImGui may be called.
  void begin_frame();
  // Keys that were pressed before this frame (GLFW_KEY_...), in order, those for the gui's own fields left out.
  const std::vector<int>& pressed_keys() const;
  // The window is to be closed.
  bool closed() const;
  // Pixel of the picture under the cursor (of a click: where it was), OpenCV's count; nothing beside the picture.
  std::optional<cv::Point2d> cursor_px() const;
  // Where a pixel of the picture lies in the window, in ImGui's coordinates.
  cv::Point2d window_from_picture(const cv::Point2d& px) const;

  void upload(const ar::OutputFrame& picture);
  // Until show(): the picture about `px` once more, `zoom` window units a pixel, within `frame` (ImGui's coordinates).
  void magnify(const cv::Point2d& px, double zoom, const cv::Rect2d& frame);
  // Draws the picture and the gui over it, and waits for the screen.
  void show();
  // Time between handing the last picture over and the screen taking it, ms.
  double swap_ms() const;

  bool full_screen() const;
  void set_full_screen(bool on);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace app
