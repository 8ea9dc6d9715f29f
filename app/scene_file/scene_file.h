#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ar/place/place.h"
#include "ar/track/tag_map.h"
#include "render/daylight/daylight.h"
#include "render/medium/medium.h"
#include "render/plan/plan.h"
#include "render/scene/model.h"
#include "render/sky/sky_model.h"

namespace app {

// `sky:`. `where` is "scene.yaml:12: sky.model", for what make_sky() may have to say about it.
struct SceneSky {
  render::SkyOptions options;
  double ground_albedo = 0.2;
  std::string where;
};

// `view:`: the camera of stills and benchmarks.
struct SceneView {
  glm::dvec3 eye_in_world{0.0};
  glm::dvec3 target_in_world{0.0};
  glm::dvec3 up_in_world{0.0, 0.0, 1.0};
  double vertical_fov_rad = 0.0;
};

// One of `objects:` or `real:`; either a model file or a procedural stand-in, already loaded.
struct SceneInstance {
  std::string name;
  std::shared_ptr<const render::Model> model;
  glm::dvec3 position_in_world{0.0};
  double heading_rad = 0.0;
  double scale = 1.0;
  bool real = false;
};

// A scene file, checked (docs/scene-file.md). What is absent in the file is absent here.
struct SceneFile {
  std::filesystem::path path;
  std::optional<ar::GeoPosition> place;
  std::optional<ar::UtcTime> time;
  std::optional<ar::TagMap> tags;
  SceneSky sky;
  std::optional<render::Medium> medium;
  std::vector<SceneInstance> instances;
  std::optional<SceneView> view;
  render::GivenSun sun;  // `sun:`: what is given replaces what place and time would say; both angles or neither
  std::optional<double> exposure;  // display-linear per cd/m2
  render::Quality quality;
};

// Reads a scene file and the models it names. Throws ar::InputError that names file, line, key, what was found and what
// would be accepted.
SceneFile load_scene_file(const std::filesystem::path& path);

}  // namespace app
