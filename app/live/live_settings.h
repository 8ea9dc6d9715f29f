#pragma once

#include <filesystem>
#include <optional>

#include "app/process/conditions.h"
#include "app/scene_file/scene_file.h"

namespace app {

enum class ExposureSource { Given, Estimate, Manual };  // Given: by the scene, else by the camera

// What can be changed while `live` runs.
struct LiveSettings {
  Conditions conditions;  // the time is that of the first frame
  SceneSky sky;
  std::optional<render::Medium> medium;
  render::Quality quality;  // the best that is wanted
  double target_ms = 0.0;   // 0: full quality, however long it takes
  ExposureSource exposure_source = ExposureSource::Given;
  double manual_exposure = 1.0 / 20000.0;  // display-linear per cd/m2
};

// Writes what differs between the two into the scene file, `now_s` seconds after the first frame, and leaves all else
// in it, comments too, as it is. The file appears whole. Throws std::runtime_error where it cannot be changed in place.
void save_settings(const std::filesystem::path& scene, const LiveSettings& before, const LiveSettings& after,
                   double now_s);

}  // namespace app
