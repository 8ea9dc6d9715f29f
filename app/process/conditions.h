#pragma once

#include <optional>
#include <string>

#include "app/scene_file/scene_file.h"
#include "ar/capture/source.h"
#include "ar/place/place.h"

namespace app {

// Where and when, with who said so. Each is taken from the command line, else the scene file, else the video.
struct Conditions {
  std::optional<ar::GeoPosition> place;
  std::optional<ar::UtcTime> time;  // of the video's first frame
  std::string place_origin;         // "the command line", "scene.yaml", "the video's metadata"
  std::string time_origin;
};

// `at` and `time` as the command line gave them; throws UsageError when they cannot be read.
Conditions resolve_conditions(const std::optional<std::string>& at, const std::optional<std::string>& time,
                              const SceneFile& scene, const ar::RecordedAt& recorded);

// "place 48.8584 N 2.2945 E, height 35 m, from the video's metadata" and the same for the time, in the log.
void log_conditions(const Conditions& conditions);

}  // namespace app
