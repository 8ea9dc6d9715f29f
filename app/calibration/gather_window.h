#pragma once

#include <memory>
#include <string>

#include "app/window/desktop_window.h"
#include "ar/capture/source.h"
#include "ar/output/frame_pool.h"
#include "calib/views/view_collector.h"

namespace app {

enum class GatherRequest { None, DropLast, Finish };

// The window of `calibrate --live`: the camera's picture, what the views taken cover of it, the outline of the view
// that is asked for, and in words what to do.
class GatherWindow {
 public:
  // Throws as DesktopWindow does.
  explicit GatherWindow(const ar::SourceInfo& source);

  // The picture of the moment.
  void upload(const ar::Frame& frame);
  // Draws all, waits for the screen, and tells what the user wants. `lost`: why there is no camera just now.
  GatherRequest show(const calib::ViewCollector& collector, const calib::Observation& seen, calib::FrameUse use,
                     const std::string& lost);

 private:
  void draw_coverage(const calib::ViewCoverage& coverage) const;
  void draw_points(const calib::Observation& seen, calib::FrameUse use) const;
  void draw_asked(const std::vector<cv::Point2d>& px) const;

  DesktopWindow window_;
  ar::FramePool pool_;
  std::size_t views_ = 0;  // that were taken when it was last shown
  int flash_ = 0;          // frames that are left of telling that a view was taken
};

}  // namespace app
