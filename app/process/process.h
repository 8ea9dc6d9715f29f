#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/options/frame_range.h"
#include "app/process/camera_choice.h"
#include "ar/output/sink.h"
#include "render/plan/plan.h"

namespace app {

// What `skyshaft process` is asked for.
struct ProcessOptions {
  std::string input;
  std::filesystem::path output;
  std::filesystem::path scene;
  CameraChoice camera;
  std::optional<std::string> at;
  std::optional<std::string> time;
  FrameRange frames;
  std::optional<std::filesystem::path> poses;
  std::optional<std::filesystem::path> report;
  ar::VideoSinkOptions sink;
  double image_frame_rate = 25.0;
  bool tone_map = false;
  std::optional<int> egl_device;
  std::optional<render::ShaftSettings> shafts;
  bool quiet = false;
};

// Reads the video, tracks it, lights and composites the scene over it, writes it. Returns kDone, or kInterrupted when
// it was told to stop and finalised what it had. Throws what goes wrong.
int process(const ProcessOptions& options);

}  // namespace app
