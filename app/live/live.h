#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/live/feed.h"
#include "app/process/camera_choice.h"
#include "ar/output/sink.h"
#include "render/plan/plan.h"

namespace app {

// What `skyshaft live` is asked for.
struct LiveOptions {
  std::string source;  // as ar::open_live_source() reads it
  ar::LiveRequest request;
  std::filesystem::path scene;
  CameraChoice camera;
  std::optional<std::string> at;
  std::optional<std::string> time;
  std::optional<std::string>
      gpsd;  // HOST:PORT, or empty for the local one: asked for the place where `at` is not given
  bool headless = false;
  bool full_screen = false;
  std::optional<double> duration_s;
  FeedOptions feed;
  std::optional<std::filesystem::path> record;
  std::vector<std::string> outputs;  // as DeviceOutput reads them
  ar::VideoSinkOptions sink;
  std::optional<std::filesystem::path> poses;
  std::optional<std::filesystem::path> report;
  std::filesystem::path stills = ".";  // folder
  std::optional<int> egl_device;
  std::optional<render::ShaftSettings> shafts;
  std::optional<double> target_ms;  // a frame's drawing may take; 0: full quality however long it takes
  bool quiet = false;
};

// Overlays the scene on a camera's pictures until the window is closed, the duration is over, the file is over or an
// interrupt. Returns kDone or kInterrupted. Throws what goes wrong; ar::InputError when the camera is lost for good,
// after the recording was finalised.
int live(const LiveOptions& options);

// The cameras that are there, with their modes, on standard output. Returns kDone.
int list_cameras();

}  // namespace app
