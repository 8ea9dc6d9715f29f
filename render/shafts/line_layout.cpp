#include "render/shafts/line_layout.h"

#include <algorithm>
#include <cmath>

namespace render {
namespace {

// Scaled so that single precision holds it and its products with pixels, however far away the sun's place is.
glm::dvec3 sun_in_px(const ShaftInputs& inputs, const glm::ivec2& picture_px) {
  const View& view = inputs.view;
  const glm::dvec3 in_camera =
      glm::transpose(view.world_from_camera) * glm::normalize(inputs.scene.sun.direction_in_world);
  const glm::dvec2 scale = glm::dvec2(picture_px) / glm::dvec2(view.width, view.height);
  const glm::dvec2 px = scale * (glm::dvec2(in_camera) * view.focal_px + in_camera.z * view.centre_px);
  const glm::dvec3 homogeneous(px, in_camera.z);
  return homogeneous / std::max({std::abs(px.x), std::abs(px.y), std::abs(in_camera.z)});
}

}  // namespace

LineLayout lay_out_lines(const ShaftInputs& inputs, const glm::ivec2& picture_px, double line_px, double sample_px) {
  LineLayout layout;
  layout.picture_px = picture_px;
  layout.sun_in_px = sun_in_px(inputs, picture_px);
  const glm::dvec3 sun = layout.sun_in_px.z < 0.0 ? -layout.sun_in_px : layout.sun_in_px;
  const glm::dvec2 size(picture_px);
  // Whether the way from the sun's place to each border leads out of the picture.
  const glm::bvec4 faces_away(sun.x > 0.0, size.x * sun.z > sun.x, sun.y > 0.0, size.y * sun.z > sun.y);
  for (int side = 0; side < 4; ++side) {
    layout.side_first[side] = layout.rows;
    if (!faces_away[side]) continue;
    layout.side_count[side] = static_cast<int>(std::ceil((side < 2 ? size.y : size.x) / line_px)) + 1;
    layout.rows += layout.side_count[side];
  }
  layout.places = std::max(static_cast<int>(std::ceil(glm::length(size) / sample_px)), 1);
  return layout;
}

glm::dvec2 LineLayout::end_px(int row) const {
  int side = 0;
  while (side < 3 && row >= side_first[side] + side_count[side]) ++side;
  const double part = static_cast<double>(row - side_first[side]) / std::max(side_count[side] - 1, 1);
  const glm::dvec2 size(picture_px);
  if (side < 2) return {side == 0 ? 0.0 : size.x, part * size.y};
  return {part * size.x, side == 2 ? 0.0 : size.y};
}

void LineLayout::set(const gl::Program& program) const {
  program.set("sun_in_px", glm::vec3(sun_in_px));
  program.set("picture_px", glm::vec2(picture_px));
  program.set("side_first", side_first);
  program.set("side_count", side_count);
  program.set("places", static_cast<float>(places));
  program.set("rows", rows);
}

}  // namespace render
