#include "render/scene/view.h"

#include <glm/gtc/matrix_transform.hpp>

namespace render {

glm::dmat4 View::clip_from_local() const {
  // x_clip = z * (2 u / width - 1) with u = fx x/z + cx; y alike, downwards; z_clip = z - 2 near, w = z.
  glm::dmat4 clip_from_camera(0.0);
  clip_from_camera[0][0] = 2.0 * focal_px.x / width;
  clip_from_camera[1][1] = 2.0 * focal_px.y / height;
  clip_from_camera[2] = {2.0 * centre_px.x / width - 1.0, 2.0 * centre_px.y / height - 1.0, 1.0, 1.0};
  clip_from_camera[3][2] = -2.0 * kNearM;
  return clip_from_camera * glm::dmat4(glm::transpose(world_from_camera));
}

glm::dmat4 View::local_from_world() const {
  return glm::translate(glm::dmat4(1.0), -eye_in_world);
}

glm::dmat3 View::local_ray_from_px() const {
  const glm::dmat3 camera_from_px({1.0 / focal_px.x, 0.0, 0.0}, {0.0, 1.0 / focal_px.y, 0.0},
                                  {-centre_px.x / focal_px.x, -centre_px.y / focal_px.y, 1.0});
  return world_from_camera * camera_from_px;
}

View pinhole_view(const Camera& camera) {
  return {.width = camera.width,
          .height = camera.height,
          .eye_in_world = glm::dvec3(camera.world_from_camera[3]),
          .world_from_camera = glm::dmat3(camera.world_from_camera),
          .focal_px = {camera.fx, camera.fy},
          .centre_px = {camera.cx, camera.cy}};
}

}  // namespace render
