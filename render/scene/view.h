#pragma once

#include <glm/glm.hpp>

#include "render/scene/scene_state.h"

namespace render {

// An ideal pinhole picture of the world, as the GPU passes need it. Shaders work in the `local` frame: the world's
// axes (east, north, up) with the origin at the eye, so that single precision suffices wherever the world's origin is.
// All that leads into it is computed in double on the CPU.
struct View {
  int width = 0;  // pixels
  int height = 0;
  glm::dvec3 eye_in_world{0.0};
  glm::dmat3 world_from_camera{1.0};  // rotation only
  glm::dvec2 focal_px{1.0};
  glm::dvec2 centre_px{0.0};  // principal point, counted from the pixel's edge

  // Row 0 of the picture is row 0 of the framebuffer (conventions.h), so clip y points down the picture.
  // Depth: infinite far plane, window depth = 1 - near_m / z with z the distance along the camera's axis.
  glm::dmat4 clip_from_local() const;
  glm::dmat4 local_from_world() const;
  // Direction of the view ray, not normalised, z along the camera = 1: ray_in_local = M * (u, v, 1) with u, v in
  // pixels counted from the edge of a picture of width x height.
  glm::dmat3 local_ray_from_px() const;

  // Nearest distance along the camera's axis that is drawn, metres.
  static constexpr double kNearM = 0.05;
};

// The view of a camera without a lens map.
View pinhole_view(const Camera& camera);

}  // namespace render
