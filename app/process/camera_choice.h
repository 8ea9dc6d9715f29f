#pragma once

#include <filesystem>
#include <optional>

#include "ar/capture/source.h"
#include "ar/track/camera.h"

namespace app {

struct CameraChoice {
  std::optional<std::filesystem::path> file;
  std::optional<double> fov_deg;  // horizontal, of the upright picture
  bool scale = false;             // accept a file for another size of the same aspect
};

// The camera of a recording, logged with what was assumed. Throws ar::InputError when the file is for another size and
// `scale` does not help.
ar::CameraModel choose_camera(const CameraChoice& choice, const ar::SourceInfo& source);

}  // namespace app
