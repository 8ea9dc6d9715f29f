#pragma once

#include <random>
#include <vector>

#include "ar/track/camera.h"
#include "ar/track/detector.h"
#include "ar/track/tag_map.h"

namespace ar::testing {

// A hand-held camera that looks at the world's origin from about `distance_m`, wanders around it and trembles at 1 to 4
// Hz. `restless` 0 stands still, 1 is a hand. `variant` gives another elevation (20 to 65 degrees) and phase.
Rigid3 world_from_camera_on_walk(double time_s, double distance_m, int variant, double restless = 1.0);

// What a perfect detector with Gaussian noise of that sigma on each coordinate finds of a map's tags. Tags that are not
// wholly in the picture, or seen from behind, are left out.
std::vector<Detection> seen_from(const CameraModel& camera, const TagMap& map, const Rigid3& world_from_camera,
                                 double noise_px, std::mt19937& random);

// Camera at `eye` that looks at `target`, its picture upright.
Rigid3 looking_at(const cv::Vec3d& eye, const cv::Vec3d& target);

}  // namespace ar::testing
