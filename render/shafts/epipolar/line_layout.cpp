#include "render/shafts/epipolar/line_layout.h"

#include <algorithm>
#include <cmath>

namespace render {
namespace {

// Scaled so that single precision holds it and its products with pixels, however far away the sun's place is.
glm::dvec3 sun_in_px(const ShaftInputs& inputs, const glm::ivec2& picture_px) {
  const View& view = inputs.view;
  const glm::dvec3 in_camera =
      glm::transpose(view.world_from_camera) * glm::normalize(sun_of(inputs.scene).direction_in_world);
  const glm::dvec2 scale = glm::dvec2(picture_px) / glm::dvec2(view.width, view.height);
  const glm::dvec2 px = scale * (glm::dvec2(in_camera) * view.focal_px + in_camera.z * view.centre_px);
  const glm::dvec3 homogeneous(px, in_camera.z);
  const double largest = std::max({std::abs(px.x), std::abs(px.y), std::abs(in_camera.z)});
  return homogeneous / (in_camera.z < 0.0 ? -largest : largest);
}

}  // namespace

LineLayout lay_out_lines(const ShaftInputs& inputs, const glm::ivec2& picture_px, double line_px, double sample_px) {
  constexpr double kMostRows = 8000.0;  // what every driver draws into, less the lines at the corners
  LineLayout layout;
  layout.picture_px = picture_px;
  layout.sample_px = sample_px;
  const glm::dvec3 sun = layout.sun_in_px = sun_in_px(inputs, picture_px);
  const glm::dvec2 size(picture_px);
  const double apart_px = std::max(line_px, 2.0 * (size.x + size.y) / kMostRows);
  // Whether the way from the sun's place to each border leads out of the picture.
  const glm::bvec4 faces_away(sun.x > 0.0, size.x * sun.z > sun.x, sun.y > 0.0, size.y * sun.z > sun.y);
  for (int side = 0; side < 4; ++side) {
    layout.side_first[side] = layout.rows;
    if (!faces_away[side]) continue;
    layout.side_count[side] = static_cast<int>(std::ceil((side < 2 ? size.y : size.x) / apart_px)) + 1;
    layout.rows += layout.side_count[side];
  }
  layout.samples = static_cast<int>(std::ceil(glm::length(size) / sample_px)) + 2;
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
  const glm::vec2 size(picture_px);
  const glm::ivec4& count = side_count;
  program.set("sun_in_px", glm::vec3(sun_in_px));
  program.set("picture_px", size);
  program.set("side_first", glm::vec4(side_first));
  program.set("rows_per_px", glm::vec2(static_cast<float>(std::max({count[0], count[1], 1}) - 1) / size.y,
                                       static_cast<float>(std::max({count[2], count[3], 1}) - 1) / size.x));
  program.set("last_row", static_cast<float>(rows - 1));
  program.set("sample_px", static_cast<float>(sample_px));
}

}  // namespace render
