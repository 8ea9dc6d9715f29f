#pragma once

#include <vector>

#include "app/live/live_window.h"
#include "ar/track/camera.h"
#include "ar/track/tag_map.h"
#include "ar/track/tracker.h"

namespace app {

// Every tag of the map and every other one that was seen, by id.
std::vector<TagState> tag_states(const ar::CameraModel& camera, const ar::TagMap& map, const ar::Track& track,
                                 const std::vector<ar::Detection>& detections);

}  // namespace app
