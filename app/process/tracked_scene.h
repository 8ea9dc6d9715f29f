#pragma once

#include <filesystem>
#include <optional>

#include "app/scene_file/scene_file.h"
#include "ar/track/tracker.h"

namespace app {

// A scene that tells where its tags are, with the shafts that the command line asks for, if any. Throws ar::InputError
// as load_scene_file() does, and where it has no tags.
SceneFile load_tracked_scene(const std::filesystem::path& path, const std::optional<render::ShaftSettings>& shafts);

ar::Tracker make_tracker(const ar::CameraModel& camera, const ar::TagMap& tags);

}  // namespace app
