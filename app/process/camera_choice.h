#pragma once

#include "app/options/camera.h"
#include "ar/capture/source.h"
#include "ar/track/camera.h"

namespace app {

// The camera of a recording, logged with what was assumed. Throws ar::InputError when the file is for another size and
// `scale` does not help.
ar::CameraModel choose_camera(const CameraChoice& choice, const ar::SourceInfo& source);

}  // namespace app
