#include "app/process/frame_renderer.h"

#include <algorithm>

#include "app/bridge.h"
#include "app/median.h"

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

FinishedFrame FrameRenderer::render(TrackedFrame tracked, double start_s,
                                    const std::function<ar::OutputFrame()>& allocate) {
  ar::Frame& frame = tracked.frame;
  if (tracked.track.state == ar::TrackState::Lost) return {std::move(frame), std::nullopt};
  render::SceneState state = scene_.at(frame.time_s - start_s);
  state.camera = camera_;
  state.camera.world_from_camera = to_render(tracked.track.world_from_camera);
  state.exposure = exposure_;
  plan_ = render::make_plan(state, quality_);
  if (!plan_.has(render::PassKind::Composite)) return {std::move(frame), std::nullopt};
  const bool timed = timing_ && rendered_++ % kTimedEvery == 0;
  renderer_.enable_timing(timed);
  ar::OutputFrame rendered = allocate();
  renderer_.composite(state, plan_, view_of(frame), view_of(rendered));
  if (timed) {
    for (const render::PassTime& pass : renderer_.pass_times()) note_pass(pass.name, pass.wall_ms);
  }
  return {std::move(frame), std::move(rendered)};
}

void FrameRenderer::note_pass(const std::string& name, double wall_ms) {
  auto found = std::find_if(pass_ms_.begin(), pass_ms_.end(), [&](const auto& pass) { return pass.first == name; });
  if (found == pass_ms_.end()) found = pass_ms_.insert(pass_ms_.end(), {name, {}});
  found->second.push_back(wall_ms);
}

std::vector<std::pair<std::string, double>> FrameRenderer::median_pass_ms() const {
  std::vector<std::pair<std::string, double>> medians;
  for (const auto& [name, times_ms] : pass_ms_) medians.emplace_back(name, median(times_ms));
  return medians;
}

}  // namespace app
