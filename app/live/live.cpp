#include "app/live/live.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>

#include "app/exit_status.h"
#include "app/live/device_output.h"
#include "app/live/draw_stage.h"
#include "app/live/live_report.h"
#include "app/live/live_window.h"
#include "app/live/recorder.h"
#include "app/live/still_writer.h"
#include "app/live/tag_states.h"
#include "app/live/track_stage.h"
#include "app/pipeline/interrupt.h"
#include "app/pipeline/progress.h"
#include "app/process/output_files.h"
#include "app/process/tracked_scene.h"
#include "ar/capture/devices/camera_list.h"
#include "ar/capture/devices/open_live_source.h"
#include "ar/error.h"
#include "ar/place/gpsd.h"

namespace app {
namespace {

// For a frame, before the window is drawn again without one: a frame that comes meanwhile has to wait for that.
constexpr std::chrono::milliseconds kFramePatience{50};
// Part of the time between two frames that drawing may take: tracking and showing need some of it too.
constexpr double kPartForDrawing = 0.75;
constexpr std::chrono::seconds kPatienceWithGps{20};
constexpr double kUsualIntervalMs = 1000.0 / 30.0;

void check_outputs(const LiveOptions& options) {
  const std::string clip = options.source.starts_with("file:") ? options.source.substr(5) : "";
  check_files({{"--source", clip}, {"--scene", options.scene}, {"--camera", options.camera.file.value_or("")}},
              {{"--record", options.record.value_or("")},
               {"--poses", options.poses.value_or("")},
               {"--report", options.report.value_or("")}},
              options.sink.overwrite);
}

// Where nobody says when it is, it is now.
Conditions live_conditions(const LiveOptions& options, const SceneFile& scene, const ar::SourceInfo& source) {
  Conditions conditions = resolve_conditions(options.at, options.time, scene, source.recorded);
  if (options.gpsd && !options.at) {
    conditions.place = ar::position_from_gpsd(*options.gpsd, kPatienceWithGps);
    conditions.place_origin = "gpsd";
  }
  if (!conditions.time) {
    conditions.time = std::chrono::floor<std::chrono::microseconds>(std::chrono::system_clock::now());
    conditions.time_origin = "the system clock";
  }
  log_conditions(conditions);
  return conditions;
}

double target_ms(const LiveOptions& options, const SceneFile& scene, const ar::SourceInfo& source) {
  if (options.target_ms) return *options.target_ms;
  if (scene.quality.shaft_demand.target_ms) return *scene.quality.shaft_demand.target_ms;
  const ar::Rational& rate = source.frame_rate;
  const double interval_ms = rate.num > 0 ? 1000.0 * rate.den / rate.num : kUsualIntervalMs;
  return kPartForDrawing * interval_ms;
}

std::unique_ptr<PosesCsv> make_poses(const LiveOptions& options) {
  if (!options.poses) return nullptr;
  return std::make_unique<PosesCsv>(*options.poses, options.sink.overwrite);
}

// One run of `live`: its stages and what they share. Drawing and showing are on the calling thread.
class Session {
 public:
  explicit Session(const LiveOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  int run();

 private:
  bool goes_on() const;
  void show(TrackedLiveFrame frame);
  void show_held();
  void hand_on(const ShownPicture& shown);
  void show_in_window(const ShownPicture& shown);
  void apply(const WindowRequests& requests, const ShownPicture& shown);
  void note_times(const ShownPicture& shown, LiveClock::time_point arrived, LiveClock::time_point drawn);
  void finish();
  void say_how_it_went() const;

  const LiveOptions& options_;
  const InterruptGuard interrupt_;
  const SceneFile scene_;
  LiveFeed feed_;
  const ar::CameraModel camera_;
  DrawStage drawing_;
  TrackStage tracking_;
  std::unique_ptr<Recorder> recorder_;
  std::vector<std::unique_ptr<LiveOutput>> outputs_;
  StillWriter stills_;
  std::unique_ptr<LiveWindow> window_;
  WindowFacts told_;  // to the window
  LiveSettings saved_settings_;
  bool closed_ = false;
  LiveFacts facts_;
  std::optional<LiveClock::time_point> first_shown_;
  LiveClock::time_point last_shown_;
};

Session::Session(const LiveOptions& options)
    : options_(options),
      scene_(load_tracked_scene(options.scene, options.shafts)),
      feed_(
          ar::open_live_source(options.source, options.request),
          [request = options.request](const std::string& identity) { return ar::open_live_source(identity, request); },
          options.feed),
      camera_(choose_camera(options.camera, feed_.info())),
      drawing_(options.egl_device, camera_, feed_.info(), scene_, live_conditions(options, scene_, feed_.info()),
               target_ms(options, scene_, feed_.info())),
      tracking_(feed_, camera_, *scene_.tags, make_poses(options)),
      stills_(options.stills, feed_.info()),
      saved_settings_(drawing_.settings()) {
  drawing_.enable_timing(options.report.has_value());
  if (options.record) recorder_ = std::make_unique<Recorder>(*options.record, feed_.info(), options.sink);
  for (const std::string& output : options.outputs) {
    outputs_.push_back(std::make_unique<DeviceOutput>(output, feed_.info()));
  }
}

Session::~Session() {
  if (!window_) return;
  window_.reset();
  drawing_.make_current();  // what is left lives there
}

bool Session::goes_on() const {
  if (closed_ || InterruptGuard::requested() || tracking_.over()) return false;
  if (!options_.duration_s || !first_shown_) return true;
  return milliseconds_between(*first_shown_, LiveClock::now()) < 1e3 * *options_.duration_s;
}

int Session::run() {
  if (!options_.headless) {
    window_ = std::make_unique<LiveWindow>(feed_.info().format, "Skyshaft: " + feed_.info().name, options_.full_screen);
    show_in_window(drawing_.blank());
  }
  drawing_.warm_up();
  feed_.start();
  tracking_.start();
  {
    Progress progress(std::nullopt, options_.quiet);
    while (goes_on()) {
      if (auto frame = tracking_.take(kFramePatience)) {
        show(std::move(*frame));
        progress.update(facts_.presented);
      } else if (!feed_.lost().empty()) {
        show_held();
      } else if (window_) {
        show_in_window(drawing_.last() ? *drawing_.last() : drawing_.blank());
      }
    }
  }
  facts_.interrupted = InterruptGuard::requested();
  finish();
  if (feed_.gave_up()) {
    throw ar::InputError(feed_.lost() +
                         "\nconnect it again; --reconnect SECONDS says how long to wait for it (0: not at all)");
  }
  return facts_.interrupted ? kInterrupted : kDone;
}

void Session::show(TrackedLiveFrame frame) {
  facts_.times.track.add(frame.track_ms);
  if (window_) {
    told_.state = ar::to_string(frame.tracked.track.state);
    told_.track_ms = frame.track_ms;
    told_.tags = tag_states(camera_, *scene_.tags, frame.tracked.track, frame.detections);
  }
  const LiveClock::time_point arrived = frame.arrived;
  const LiveClock::time_point start = LiveClock::now();
  const ShownPicture shown = drawing_.draw(std::move(frame));
  const LiveClock::time_point drawn = LiveClock::now();
  facts_.times.draw.add(milliseconds_between(start, drawn));
  told_.draw_ms = milliseconds_between(start, drawn);
  hand_on(shown);
  if (window_) show_in_window(shown);
  note_times(shown, arrived, drawn);
}

void Session::note_times(const ShownPicture& shown, LiveClock::time_point arrived, LiveClock::time_point drawn) {
  const LiveClock::time_point now = LiveClock::now();
  facts_.times.present.add(milliseconds_between(drawn, now));
  told_.latency_ms = age_ms(shown.time_s, now);
  facts_.times.latency.add(told_.latency_ms);
  facts_.times.pipeline.add(milliseconds_between(arrived, now));
  if (first_shown_) facts_.times.interval.add(milliseconds_between(last_shown_, now));
  if (!first_shown_) first_shown_ = now;
  last_shown_ = now;
  ++facts_.presented;
}

void Session::show_in_window(const ShownPicture& shown) {
  const FeedCounts feed = feed_.counts();
  const render::Quality& quality = drawing_.quality();
  told_.lost = feed_.lost();
  told_.per_second = facts_.times.interval.count() > 0 ? 1e3 / facts_.times.interval.mean_ms() : 0.0;
  told_.dropped = feed.stale + feed.missed + feed.damaged + tracking_.stale();
  told_.quality = fmt::format("drawn at {:.2f}{}, {:.0f} ms behind", quality.render_scale,
                              quality.anti_alias ? ", smooth edges" : "", told_.latency_ms);
  told_.exposure = drawing_.exposure().exposure;
  told_.elapsed_s = drawing_.elapsed_s();
  const WindowRequests requests = window_->show(shown, told_, drawing_.settings());
  drawing_.make_current();
  apply(requests, shown);
}

void Session::apply(const WindowRequests& requests, const ShownPicture& shown) {
  closed_ = closed_ || requests.close;
  try {
    if (requests.settings) drawing_.apply(*requests.settings);
    if (requests.still) window_->say(stills_.write(shown));
    if (!requests.save) return;
    save_settings(options_.scene, saved_settings_, drawing_.settings(), drawing_.elapsed_s());
    saved_settings_ = drawing_.settings();
    window_->say("written into " + options_.scene.string());
  } catch (const std::runtime_error& error) {
    window_->say(error.what());
  }
}

void Session::hand_on(const ShownPicture& shown) {
  if (recorder_) recorder_->show(shown);
  for (const auto& output : outputs_) output->show(shown);
}

void Session::show_held() {
  const auto held = drawing_.held();
  if (!held) return;
  if (window_) show_in_window(*held);
  ++facts_.held;
  hand_on(*held);
}

void Session::finish() {
  feed_.stop();
  tracking_.finish();
  if (recorder_) {
    recorder_->finish();
    facts_.recorded = recorder_->recorded();
    facts_.left_out = recorder_->left_out();
  }
  stills_.finish();
  facts_.feed = feed_.counts();
  facts_.tracked = tracking_.counts();
  facts_.stale_tracked = tracking_.stale();
  if (first_shown_) facts_.wall_s = milliseconds_between(*first_shown_, last_shown_) / 1e3;
  if (options_.report) write_live_report(*options_.report, feed_.info(), facts_, drawing_);
  say_how_it_went();
}

void Session::say_how_it_went() const {
  const LiveTimes& times = facts_.times;
  spdlog::info("{} frames shown in {:.1f} s, {:.1f} a second, {} dropped; {} tracking, {} predicted, {} lost",
               facts_.presented, facts_.wall_s, facts_.per_second(), facts_.dropped(), facts_.tracked.tracking,
               facts_.tracked.predicted, facts_.tracked.lost);
  spdlog::info("latency {:.1f} ms (99 %: {:.1f}), of it in the program {:.1f} (99 %: {:.1f}), drawing {:.1f}",
               times.latency.percentile_ms(0.5), times.latency.percentile_ms(0.99), times.pipeline.percentile_ms(0.5),
               times.pipeline.percentile_ms(0.99), times.draw.percentile_ms(0.5));
  if (facts_.left_out > 0) {
    spdlog::warn("{} frames are not in the recording: the encoder could not keep up\ntry --preset ultrafast, or --crf",
                 facts_.left_out);
  }
}

}  // namespace

int list_cameras() {
  const auto cameras = ar::list_cameras();
  for (const ar::CameraListing& camera : cameras) {
    fmt::print("{}  {}\n", camera.source, camera.name);
    if (!camera.problem.empty()) fmt::print("    cannot be used: {}\n", camera.problem);
    for (const ar::CameraMode& mode : camera.modes) fmt::print("    {}\n", ar::describe(mode));
  }
  if (cameras.empty()) {
    spdlog::warn("no camera is there\nplug one in; /dev/video* are its nodes, which the group `video` may open");
  }
  return kDone;
}

int live(const LiveOptions& options) {
  check_outputs(options);
  return Session(options).run();
}

}  // namespace app
