#include "app/process/frame_renderer.h"

#include <algorithm>
#include <cmath>

#include "app/process/bridge.h"

namespace app {
namespace {

constexpr std::int64_t kTimedEvery = 8;

}  // namespace

FrameRenderer::FrameRenderer(std::optional<int> egl_device, const ar::CameraModel& camera, SceneStateBuilder scene,
                             const render::Quality& quality)
    : context_(egl_device),
      renderer_(context_),
      camera_(to_render(camera)),
      scene_(std::move(scene)),
      quality_(quality) {}

render::SceneState FrameRenderer::light_at(double elapsed_s) {
  return scene_.at(light_step_s_ > 0.0 ? light_step_s_ * std::floor(elapsed_s / light_step_s_) : elapsed_s);
}

FinishedFrame FrameRenderer::render(TrackedFrame tracked, double start_s,
                                    const std::function<ar::OutputFrame()>& allocate) {
  ar::Frame& frame = tracked.frame;
  if (tracked.track.state == ar::TrackState::Lost) return {std::move(frame), std::nullopt};
  render::SceneState state = light_at(frame.time_s - start_s);
  state.camera = camera_;
  state.camera.world_from_camera = to_render(tracked.track.world_from_camera);
  state.exposure = exposure_;
  plan_ = render::make_plan(state, quality_, render::Target::Video);
  if (plan_.passes.empty()) return {std::move(frame), std::nullopt};
  const bool timed = timing_ && rendered_++ % kTimedEvery == 0;
  renderer_.enable_timing(timed);
  ar::OutputFrame rendered = allocate();
  renderer_.composite(state, plan_, view_of(frame), view_of(rendered));
  if (timed) {
    for (const render::PassTime& pass : renderer_.pass_times()) note_pass(pass);
  }
  return {std::move(frame), std::move(rendered)};
}

void FrameRenderer::note_pass(const render::PassTime& pass) {
  auto found = std::ranges::find(pass_times_, pass.name, &PassTimes::name);
  if (found == pass_times_.end()) found = pass_times_.insert(pass_times_.end(), {pass.name, {}, {}});
  found->wall_ms.add(pass.wall_ms);
  found->cpu_ms.add(pass.cpu_ms);
}

std::vector<std::pair<std::string, double>> FrameRenderer::median_pass_ms() const {
  std::vector<std::pair<std::string, double>> medians;
  for (const PassTimes& pass : pass_times_) medians.emplace_back(pass.name, pass.wall_ms.median());
  return medians;
}

std::vector<std::pair<std::string, double>> FrameRenderer::median_pass_cpu_ms() const {
  std::vector<std::pair<std::string, double>> medians;
  for (const PassTimes& pass : pass_times_) medians.emplace_back(pass.name, pass.cpu_ms.median());
  return medians;
}

}  // namespace app
