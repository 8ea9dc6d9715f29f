#include "app/process/bridge.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "app/process/scene_state_builder.h"

namespace app {
namespace {

std::shared_ptr<const render::LensMap> make_lens_map(const ar::CameraModel& camera) {
  auto map = std::make_shared<render::LensMap>();
  map->width = camera.width;
  map->height = camera.height;
  map->ideal.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  std::vector<cv::Point2d> row(static_cast<std::size_t>(camera.width));
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) row[static_cast<std::size_t>(x)] = {double(x), double(y)};
    for (const cv::Point2d& ideal : ar::undistort_to_ideal(camera, row)) map->ideal.emplace_back(ideal.x, ideal.y);
  }
  return map;
}

template <typename T>
T known(T value, const char* what) {
  if (value != T::Unknown) return value;
  throw std::logic_error(fmt::format("the {} of a frame is unknown when it is to be rendered", what));
}

}  // namespace

glm::dmat4 to_render(const ar::Rigid3& b_from_a) {
  glm::dmat4 matrix(1.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix[column][row] = b_from_a.rotation(row, column);
    matrix[3][row] = b_from_a.translation[row];
  }
  return matrix;
}

render::Camera to_render(const ar::CameraModel& camera) {
  render::Camera converted;
  converted.width = camera.width;
  converted.height = camera.height;
  converted.fx = camera.intrinsics(0, 0);
  converted.fy = camera.intrinsics(1, 1);
  const auto centre = render::edge_from_centre_px({camera.intrinsics(0, 2), camera.intrinsics(1, 2)});
  converted.cx = centre.x;
  converted.cy = centre.y;
  if (camera.lens != ar::LensModel::None) converted.lens = make_lens_map(camera);
  return converted;
}

render::PictureFormat to_render(const ar::PixelFormat& format) {
  return {.width = format.width,
          .height = format.height,
          .bit_depth = format.bit_depth,
          .chroma = format.chroma,
          .siting = known(format.color.siting, "chroma siting"),
          .matrix = known(format.color.matrix, "colour matrix"),
          .range = known(format.color.range, "colour range"),
          .transfer = known(format.color.transfer, "transfer function")};
}

render::PictureView view_of(const ar::Frame& frame) {
  return {to_render(frame.format), frame.plane, frame.stride_bytes};
}

render::MutablePictureView view_of(const ar::OutputFrame& frame) {
  return {to_render(frame.format), frame.plane, frame.stride_bytes};
}

ar::SceneLight scene_light_of(const render::SceneState& state) {
  return {.horizontal_illuminance_lux = horizontal_illuminance(state), .default_exposure = state.exposure};
}

}  // namespace app
