#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "render/medium/medium.h"
#include "render/scene/light.h"
#include "render/scene/model.h"
#include "render/sky/sky_light.h"

namespace render {

// Pixel coordinates: OpenCV's count (centre of the first pixel 0.0) and GL's (0.5).
inline glm::dvec2 edge_from_centre_px(const glm::dvec2& centre_px) {
  return centre_px + 0.5;
}
inline glm::dvec2 centre_from_edge_px(const glm::dvec2& edge_px) {
  return edge_px - 0.5;
}

// Where each pixel of a distorted picture looks: normalised ideal coordinates (x/z, y/z) of the camera's frame at the
// pixel's centre; NaN where the lens model has no inverse. Row 0 at the top.
struct LensMap {
  int width = 0;
  int height = 0;
  std::vector<glm::vec2> ideal;  // width * height
};

// The camera of one frame. Without a lens map: pinhole, ideal = ((u - cx) / fx, (v - cy) / fy) with u, v counted from
// the pixel's edge (GL's count).
struct Camera {
  int width = 0;
  int height = 0;
  double fx = 1.0;
  double fy = 1.0;
  double cx = 0.0;  // edge count: the middle of a W wide picture is W / 2
  double cy = 0.0;
  std::shared_ptr<const LensMap> lens;  // absent: no distortion. Replaces fx ... cy where present
  glm::dmat4 world_from_camera{1.0};    // rigid; camera x right, y down, z forward
};

// Everything about one instant, as plain values. Building it needs no GL.
struct SceneState {
  Camera camera;
  std::vector<Instance> instances;      // virtual and real
  std::vector<Light> lights;            // one sun at most; none: dark but for the sky
  std::shared_ptr<const SkyModel> sky;  // absent: no sky light, black background
  SkyLight sky_light;
  std::optional<Medium> medium;
  double exposure = 1.0 / 20000.0;  // display-linear per cd/m2
  bool draw_virtual = true;         // false while the tracker is lost: the picture passes through
};

// The scene's sun; one without illuminance where it has none.
const Sun& sun_of(const SceneState& scene);

// The scene's sun to be changed; one without illuminance is added first where it has none. Valid until a light is added
// or taken away.
Sun& ensure_sun(SceneState& scene);

}  // namespace render
