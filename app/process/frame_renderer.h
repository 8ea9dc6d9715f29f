#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/pipeline/pipeline.h"
#include "app/pipeline/reservoir.h"
#include "app/process/scene_state_builder.h"
#include "ar/output/sink.h"
#include "ar/track/camera.h"
#include "render/gl/context.h"
#include "render/plan/renderer.h"

namespace app {

// The render stage: lights the scene at a frame's time, sees it from the frame's pose, composites it over the frame.
// Lives on one thread, the GL context's.
class FrameRenderer {
 public:
  FrameRenderer(std::optional<int> egl_device, const ar::CameraModel& camera, SceneStateBuilder scene,
                const render::Quality& quality);

  // Where another GL context was current on this thread meanwhile.
  void make_current() { context_.make_current(); }
  void set_exposure(double exposure) { exposure_ = exposure; }
  // From the next frame on.
  void set_quality(const render::Quality& quality) { quality_ = quality; }
  void set_scene(SceneStateBuilder scene) { scene_ = std::move(scene); }
  // Sun and sky step no more often than that: a step takes some 40 ms without a GPU. 0: as SceneStateBuilder does.
  void set_light_step(double step_s) { light_step_s_ = step_s; }
  // The light at that time, without a camera.
  render::SceneState light_at(double elapsed_s);
  // Measures the passes of some frames; what is measured waits for the GPU, so not of all of them.
  void enable_timing(bool on) { timing_ = on; }

  // `start_s` is the time_s at which the scene's clock stands at its beginning. Buffers come from `allocate`. A frame
  // in which nothing virtual is to be drawn is handed on as it is.
  FinishedFrame render(TrackedFrame frame, double start_s, const std::function<ar::OutputFrame()>& allocate);

  const std::string& renderer_name() const { return context_.renderer_name(); }
  const render::Plan& last_plan() const { return plan_; }
  // In the order in which they run.
  std::vector<std::pair<std::string, double>> median_pass_ms() const;
  std::vector<std::pair<std::string, double>> median_pass_cpu_ms() const;

 private:
  struct PassTimes {
    std::string name;
    Reservoir wall_ms;
    Reservoir cpu_ms;
  };

  void note_pass(const render::PassTime& pass);

  render::gl::Context context_;
  render::Renderer renderer_;
  render::Camera camera_;
  SceneStateBuilder scene_;
  render::Quality quality_;
  double exposure_ = 0.0;
  double light_step_s_ = 0.0;
  bool timing_ = false;
  render::Plan plan_;
  std::int64_t rendered_ = 0;
  std::vector<PassTimes> pass_times_;
};

}  // namespace app
