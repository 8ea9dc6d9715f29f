#pragma once

#include <string>

#include "app/live/governor.h"
#include "app/live/live_frame.h"
#include "app/live/live_settings.h"
#include "app/process/frame_renderer.h"
#include "app/scene_file/scene_file.h"
#include "ar/output/frame_pool.h"
#include "ar/photometry/exposure.h"

namespace app {

// Draws the scene over tracked frames with the settings of the moment. Lives on the thread that made it.
class DrawStage {
 public:
  // `target_ms` is what a frame may take, 0: whatever it takes.
  DrawStage(std::optional<int> egl_device, const ar::CameraModel& camera, const ar::SourceInfo& source, SceneFile scene,
            const Conditions& conditions, double target_ms);

  // Measures the passes of some frames.
  void enable_timing(bool on) { renderer_.enable_timing(on); }

  // Draws pictures of nothing with every setting that the governor will choose, so that no shader is made while frames
  // wait, and begins with the best that is fast enough.
  void warm_up();

  // The frame with the scene over it; as it is while its pose is not known.
  ShownPicture draw(TrackedLiveFrame frame);
  // The last picture with a mark on it that says that it stands still. Nothing before the first.
  std::optional<ShownPicture> held();
  const std::optional<ShownPicture>& last() const { return last_; }

  void make_current() { renderer_.make_current(); }
  // A dark picture for as long as there is no other.
  ShownPicture blank();

  const LiveSettings& settings() const { return settings_; }
  // From the next frame on. Throws what SceneStateBuilder throws, and leaves all as it was.
  void apply(const LiveSettings& settings);
  // Seconds from the first frame to the last drawn.
  double elapsed_s() const { return elapsed_s_; }

  const FrameRenderer& renderer() const { return renderer_; }
  const ar::ExposureChoice& exposure() const { return exposure_; }
  const Governor& governor() const { return governor_; }
  const render::Quality& quality() const { return presets_.at(governor_.level()); }

 private:
  TrackedFrame imagined_frame();
  ar::ExposureChoice exposure_of(const ar::Frame& frame);
  void choose_exposure(const ar::Frame& frame);

  SceneFile scene_;
  ar::FramePool pool_;
  const ar::PixelFormat format_;
  LiveSettings settings_;
  FrameRenderer renderer_;
  std::vector<render::Quality> presets_;
  Governor governor_;
  ar::ExposureChoice exposure_;
  std::optional<double> start_s_;  // time of the first frame
  double elapsed_s_ = 0.0;
  std::int64_t frames_ = 0;
  std::optional<ShownPicture> last_;
  std::optional<ShownPicture> held_;  // the last one with the mark, once it was asked for
};

}  // namespace app
