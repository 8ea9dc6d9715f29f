#include "app/process/tracked_scene.h"

#include <fmt/format.h>

#include "ar/error.h"

namespace app {

SceneFile load_tracked_scene(const std::filesystem::path& path, const std::optional<render::ShaftSettings>& shafts) {
  SceneFile scene = load_scene_file(path);
  if (!scene.tags) {
    throw ar::InputError(
        fmt::format("{}: found no 'tags'; accepted: the tags whose places tell where the camera is\n"
                    "add `tags: {{ family: tag36h11, size: 0.16, map: [...] }}`",
                    path.string()));
  }
  if (shafts) scene.quality.shafts = *shafts;
  return scene;
}

ar::Tracker make_tracker(const ar::CameraModel& camera, const ar::TagMap& tags) {
  ar::TrackerOptions options;
  options.detector.families = {tags.family};
  return {camera, tags, options};
}

}  // namespace app
