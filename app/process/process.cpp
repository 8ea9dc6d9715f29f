#include "app/process/process.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <memory>
#include <set>

#include "app/exit_status.h"
#include "app/pipeline/interrupt.h"
#include "app/pipeline/pipeline.h"
#include "app/pipeline/progress.h"
#include "app/process/bridge.h"
#include "app/process/conditions.h"
#include "app/process/frame_reader.h"
#include "app/process/frame_renderer.h"
#include "app/process/output_files.h"
#include "app/process/poses_csv.h"
#include "app/process/report.h"
#include "app/process/scene_state_builder.h"
#include "app/process/tracked_scene.h"
#include "app/scene_file/scene_file.h"
#include "ar/capture/file/open_source.h"
#include "ar/error.h"
#include "ar/photometry/exposure.h"
#include "ar/track/tracker.h"

namespace app {
namespace {

// Frames that the plain exposure estimate looks at.
constexpr std::size_t kFramesForExposure = 5;

void check_outputs(const ProcessOptions& options) {
  check_files(
      {{"IN", options.input}, {"--scene", options.scene}, {"--camera", options.camera.file.value_or("")}},
      {{"-o", options.output}, {"--poses", options.poses.value_or("")}, {"--report", options.report.value_or("")}},
      options.sink.overwrite);
}

ar::OpenOptions open_options(const ProcessOptions& options) {
  ar::OpenOptions open;
  open.tone_map_hdr = options.tone_map;
  open.image_frame_rate = options.image_frame_rate;
  return open;
}

Conditions announced(Conditions conditions) {
  log_conditions(conditions);
  return conditions;
}

// One run of `process`: its stages and what they share.
class Job {
 public:
  explicit Job(const ProcessOptions& options);
  int run();

 private:
  void choose_exposure();
  TrackedFrame track(ar::Frame frame);
  FinishedFrame render(TrackedFrame frame);
  void encode(FinishedFrame frame);
  void finish();
  void say_what_was_seen() const;

  const ProcessOptions& options_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const InterruptGuard interrupt_;
  const SceneFile scene_;
  const std::unique_ptr<ar::FrameSource> source_;
  FrameReader reader_;
  const ar::CameraModel camera_;
  SceneStateBuilder builder_;
  FrameRenderer renderer_;
  ar::Tracker tracker_;
  std::unique_ptr<ar::FrameSink> sink_;
  std::unique_ptr<PosesCsv> poses_;
  RunFacts facts_;
  std::set<int> unmapped_ids_;  // ids seen that the scene does not place
  std::int64_t encoded_ = 0;
  std::unique_ptr<Progress> progress_;
};

Job::Job(const ProcessOptions& options)
    : options_(options),
      scene_(load_tracked_scene(options.scene, options.shafts)),
      source_(ar::open_source(options.input, open_options(options))),
      reader_(*source_, options.frames),
      camera_(choose_camera(options.camera, source_->info())),
      builder_(scene_, announced(resolve_conditions(options.at, options.time, scene_, source_->info().recorded))),
      renderer_(options.egl_device, camera_, builder_, scene_.quality),
      tracker_(make_tracker(camera_, *scene_.tags)) {
  choose_exposure();
  sink_ = ar::make_file_sink(options.output, source_->info(), options.sink);
  if (options.poses) poses_ = std::make_unique<PosesCsv>(*options.poses, options.sink.overwrite);
  renderer_.enable_timing(options.report.has_value());
}

void Job::choose_exposure() {
  const render::SceneState state = builder_.at(0.0);
  log_light(state);
  const ar::ExposureChoice choice =
      ar::choose_exposure(builder_.exposure(), scene_light_of(state), reader_.peek(kFramesForExposure));
  facts_.exposure = choice.exposure;
  facts_.exposure_origin = choice.origin;
  spdlog::info("exposure: white at {:.0f} cd/m2, from {}", 1.0 / facts_.exposure, facts_.exposure_origin);
  renderer_.set_exposure(facts_.exposure);
}

TrackedFrame Job::track(ar::Frame frame) {
  ar::Track track = tracker_.track(frame);
  facts_.frames.add(track.state);
  for (const ar::Detection& detection : tracker_.detections()) {
    if (!scene_.tags->tags.contains(detection.id)) unmapped_ids_.insert(detection.id);
  }
  if (poses_) poses_->add(frame.index, frame.time_s, track);
  return {std::move(frame), std::move(track)};
}

FinishedFrame Job::render(TrackedFrame frame) {
  return renderer_.render(std::move(frame), reader_.start_s(), [this] { return sink_->allocate(); });
}

void Job::encode(FinishedFrame frame) {
  if (frame.rendered) {
    sink_->write(std::move(*frame.rendered), frame.source.pts);
  } else {
    ++facts_.frames.untouched;
    sink_->write_untouched(std::move(frame.source));
  }
  progress_->update(++encoded_);
}

int Job::run() {
  progress_ = std::make_unique<Progress>(reader_.expected(), options_.quiet);
  facts_.stages = run_pipeline({.decode = [this] { return reader_.next(); },
                                .track = [this](ar::Frame frame) { return track(std::move(frame)); },
                                .render = [this](TrackedFrame frame) { return render(std::move(frame)); },
                                .encode = [this](FinishedFrame frame) { encode(std::move(frame)); }});
  progress_.reset();
  facts_.interrupted = InterruptGuard::requested();
  if (encoded_ == 0 && facts_.interrupted) return kInterrupted;
  if (encoded_ == 0) {
    throw ar::InputError(
        fmt::format("{}: no frame to process\ncheck --frames against the length of the video", options_.input));
  }
  finish();
  return facts_.interrupted ? kInterrupted : kDone;
}

void Job::finish() {
  sink_->finish();
  if (poses_) poses_->finish();
  facts_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  facts_.median_pass_ms = renderer_.median_pass_ms();
  facts_.plan = renderer_.last_plan();
  facts_.renderer = renderer_.renderer_name();
  if (options_.report) write_report(*options_.report, options_, source_->info(), facts_);
  say_what_was_seen();
}

void Job::say_what_was_seen() const {
  const FrameCounts& frames = facts_.frames;
  spdlog::info("{}: {} frames ({} tracking, {} predicted, {} lost) in {:.1f} s, {:.1f} a second",
               options_.output.string(), frames.total(), frames.tracking, frames.predicted, frames.lost, facts_.wall_s,
               static_cast<double>(frames.total()) / facts_.wall_s);
  if (frames.tracking > 0) return;
  const std::string others =
      unmapped_ids_.empty() ? "no tag of the family either"
                            : fmt::format("but these ids, which it does not place: {}", fmt::join(unmapped_ids_, ", "));
  spdlog::warn(
      "no tag of the scene was seen in the whole video, {}: its pictures went through unchanged\n"
      "check `tags:` (family {}) and that a whole tag with its white margin is in view",
      others, scene_.tags->family);
}

}  // namespace

int process(const ProcessOptions& options) {
  check_outputs(options);
  return Job(options).run();
}

}  // namespace app
