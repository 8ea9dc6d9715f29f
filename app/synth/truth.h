#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/synth/path.h"
#include "app/synth/spec.h"

namespace app::synth {

// A tag's true corners in one frame, in the middle of its exposure.
struct TrueTag {
  int id = 0;
  std::array<cv::Point2d, 4> corners_px;  // library's order, OpenCV's count
  bool whole = false;                     // all four corners inside the picture, seen from the printed side
};

// Tags whose corners all lie before the camera, by id.
std::vector<TrueTag> true_tags(const Spec& spec, const ar::Rigid3& world_from_camera);

// The files beside a clip, named after it: NAME.truth.csv, NAME.corners.csv, NAME.camera.yaml, NAME.scene.yaml.
struct TruthFiles {
  std::filesystem::path poses, corners, camera, scene;
  explicit TruthFiles(const std::filesystem::path& clip);
};

// Writes all four. `exposure`: display-linear per cd/m2. Throws std::runtime_error that names the file.
void write_truth(const TruthFiles& files, const Spec& spec, const CameraPath& path, double exposure);

}  // namespace app::synth
