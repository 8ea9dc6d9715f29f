#pragma once

#include <vector>

#include "app/live/window.h"
#include "ar/track/camera.h"
#include "ar/track/tag_map.h"
#include "ar/track/tracker.h"

namespace app {

// Of each tag that was seen, how far its corners lie from where pose and map put them.
std::vector<SeenTagError> tag_errors(const ar::CameraModel& camera, const ar::TagMap& map, const ar::Track& track,
                                     const std::vector<ar::Detection>& detections);

}  // namespace app
