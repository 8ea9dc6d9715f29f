#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/pipeline/pipeline.h"
#include "app/process/process.h"
#include "ar/capture/source.h"

namespace app {

// Frames of a run by what became of them.
struct FrameCounts {
  std::int64_t tracking = 0;
  std::int64_t predicted = 0;
  std::int64_t lost = 0;
  std::int64_t untouched = 0;  // handed on as they came: lost, or nothing virtual to draw

  std::int64_t total() const { return tracking + predicted + lost; }
  void add(ar::TrackState state);
};

// What a run leaves behind for whoever measures it.
struct RunFacts {
  FrameCounts frames;
  std::vector<StageTime> stages;
  std::vector<std::pair<std::string, double>> median_pass_ms;
  render::Plan plan;  // of the last frame that was rendered
  double wall_s = 0.0;
  double exposure = 0.0;
  std::string exposure_origin;
  std::string renderer;
  bool interrupted = false;
};

// Writes the facts as JSON, whole or not at all. Throws std::runtime_error when it cannot.
void write_report(const std::filesystem::path& path, const ProcessOptions& options, const ar::SourceInfo& source,
                  const RunFacts& facts);

}  // namespace app
