#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/scene_file/scene_file.h"
#include "render/plan/shaft_table.h"
#include "render/scene/scene_state.h"

namespace CLI {
class App;
}

namespace app {

// Options that `render` and `explain` share: a scene seen without a video.
struct StillArguments {
  std::filesystem::path scene;
  std::optional<std::string> at;
  std::optional<std::string> time;
  std::string shafts;
  render::ShaftDemand shaft_demand;  // replaces the scene's technique, unless --shafts names one
  std::string size = "1280x720";
};
void add_still_options(CLI::App& command, StillArguments& arguments);

// A scene at its place and time, seen from its `view`.
struct Still {
  SceneFile scene;
  render::SceneState state;
};

// Loads the scene and says what it found. Without an exposure in the scene a white sheet on open level ground is
// picture white. Without a `view` there the camera keeps its size only. Throws as load_scene_file() and
// SceneStateBuilder do, and UsageError for a size that cannot be read.
Still make_still(const StillArguments& arguments);

}  // namespace app
