#include "app/live/draw_stage.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/live/held_mark.h"
#include "app/live/warm_up_view.h"
#include "app/process/bridge.h"
#include "render/composite/composite_pass.h"

namespace app {
namespace {

// An estimate of the exposure follows the camera's own slowly: each time that many frames later, by that part.
constexpr std::int64_t kEstimateEvery = 15;
constexpr double kEstimateStep = 0.3;
// So many times too slow that no view of the scene will be quick enough.
constexpr double kHopeless = 2.5;
// The sun moves a twelfth of its own width in it.
constexpr double kLightStepS = 10.0;
constexpr int kMediumGrey = 110;

ar::Frame as_source(const ar::OutputFrame& picture) {
  ar::Frame frame;
  frame.format = picture.format;
  for (std::size_t p = 0; p < 3; ++p) {
    frame.plane[p] = picture.plane[p];
    frame.stride_bytes[p] = picture.stride_bytes[p];
  }
  frame.owner = picture.owner;
  return frame;
}

void fill_grey(ar::OutputFrame& picture) {
  for (std::size_t p = 0; p < 3; ++p) {
    const bool halved = p > 0 && picture.format.chroma == ar::Chroma::C420;
    const int rows = halved ? (picture.format.height + 1) / 2 : picture.format.height;
    for (int y = 0; y < rows; ++y) {
      std::memset(picture.plane[p] + y * picture.stride_bytes[p], picture.format.bit_depth == 8 ? kMediumGrey : 1,
                  static_cast<std::size_t>(picture.stride_bytes[p]));
    }
  }
}

}  // namespace

DrawStage::DrawStage(std::optional<int> egl_device, const ar::CameraModel& camera, const ar::SourceInfo& source,
                     SceneFile scene, const Conditions& conditions, double target_ms)
    : scene_(std::move(scene)),
      pool_(source.format),
      format_(source.format),
      settings_{.conditions = conditions,
                .sky = scene_.sky,
                .medium = scene_.medium,
                .quality = scene_.quality,
                .target_ms = target_ms},
      renderer_(egl_device, camera, SceneStateBuilder(scene_, conditions), scene_.quality),
      presets_(quality_presets(scene_.quality)),
      governor_(presets_.size(), target_ms) {
  renderer_.set_light_step(kLightStepS);
}

void DrawStage::apply(const LiveSettings& settings) {
  SceneFile scene = scene_;
  scene.sky = settings.sky;
  scene.medium = settings.medium;
  scene.quality = settings.quality;
  renderer_.set_scene(SceneStateBuilder(scene, settings.conditions));
  scene_ = std::move(scene);
  presets_ = quality_presets(scene_.quality);
  if (settings.target_ms != settings_.target_ms) governor_.set_target_ms(settings.target_ms);
  settings_ = settings;
  frames_ = 0;  // the exposure is chosen anew
  renderer_.set_quality(quality());
}

ShownPicture DrawStage::blank() {
  ShownPicture blank{.picture = pool_.allocate()};
  fill_grey(blank.picture);
  return blank;
}

TrackedFrame DrawStage::imagined_frame() {
  ar::OutputFrame picture = pool_.allocate();
  fill_grey(picture);
  TrackedFrame imagined{as_source(picture), {}};
  imagined.track.state = ar::TrackState::Tracking;
  imagined.track.world_from_camera = pose_with_all_in_view(scene_);
  return imagined;
}

void DrawStage::warm_up() {
  renderer_.set_exposure(1.0 / 20000.0);
  constexpr int kRounds = 3;  // the first makes the shaders
  std::size_t fits = presets_.size() - 1;
  for (std::size_t level = governor_.target_ms() > 0.0 ? presets_.size() : 1; level-- > 0;) {
    renderer_.set_quality(presets_.at(level));
    double quickest_ms = 1e9;
    for (int round = 0; round < kRounds; ++round) {
      const auto start = LiveClock::now();
      renderer_.render(imagined_frame(), 0.0, [this] { return pool_.allocate(); });
      quickest_ms = std::min(quickest_ms, milliseconds_between(start, LiveClock::now()));
    }
    spdlog::debug("quality level {}: {:.1f} ms a frame", level, quickest_ms);
    if (quickest_ms <= governor_.target_ms()) fits = level;
    if (quickest_ms > kHopeless * governor_.target_ms()) break;  // what costs more is out of reach
  }
  governor_ = Governor(presets_.size(), governor_.target_ms(), governor_.target_ms() > 0.0 ? fits : 0);
  renderer_.set_quality(quality());
}

ar::ExposureChoice DrawStage::exposure_of(const ar::Frame& frame) {
  if (settings_.exposure_source == ExposureSource::Manual) return {settings_.manual_exposure, "the panel"};
  const bool given = settings_.exposure_source == ExposureSource::Given;
  ar::Frame plain;
  plain.format = frame.format;
  plain.plane = frame.plane;
  plain.stride_bytes = frame.stride_bytes;
  if (given) plain.exposure = frame.exposure;
  return ar::choose_exposure(given ? scene_.exposure : std::nullopt, scene_light_of(renderer_.light_at(elapsed_s_)),
                             {&plain});
}

void DrawStage::choose_exposure(const ar::Frame& frame) {
  const bool anew = frames_++ == 0;
  if (!anew && frames_ % kEstimateEvery != 0) return;
  const ar::ExposureChoice now = exposure_of(frame);
  if (anew) {
    if (exposure_.origin.empty()) {
      log_light(renderer_.light_at(elapsed_s_));
      spdlog::info("exposure: white at {:.0f} cd/m2, from {}", 1.0 / now.exposure, now.origin);
    }
    exposure_ = now;
  } else {
    exposure_.exposure *= std::pow(now.exposure / exposure_.exposure, kEstimateStep);
  }
  renderer_.set_exposure(exposure_.exposure);
}

ShownPicture DrawStage::draw(TrackedLiveFrame frame) {
  const auto start = LiveClock::now();
  const double time_s = frame.tracked.frame.time_s;
  if (!start_s_) start_s_ = time_s;
  elapsed_s_ = time_s - *start_s_;
  choose_exposure(frame.tracked.frame);
  FinishedFrame finished = renderer_.render(std::move(frame.tracked), *start_s_, [this] { return pool_.allocate(); });
  if (finished.rendered) {
    if (governor_.add(milliseconds_between(start, LiveClock::now()))) renderer_.set_quality(quality());
  } else {
    finished.rendered = pool_.allocate();
    render::copy_picture(view_of(finished.source), view_of(*finished.rendered));
  }
  last_ = {.picture = std::move(*finished.rendered), .time_s = time_s, .held = false};
  held_.reset();
  return *last_;
}

std::optional<ShownPicture> DrawStage::held() {
  if (held_ || !last_) return held_;
  // What was shown may still be on its way into the recording: the mark goes onto a copy.
  ar::FramePool pool(format_);
  ShownPicture marked{.picture = pool.allocate(), .time_s = last_->time_s, .held = true};
  const ar::Frame source = as_source(last_->picture);
  render::copy_picture(view_of(source), view_of(marked.picture));
  mark_as_held(marked.picture);
  held_ = std::move(marked);
  return held_;
}

}  // namespace app
