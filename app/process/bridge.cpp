#include "app/process/bridge.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

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

[[noreturn]] void unknown(const char* what) {
  throw std::logic_error(fmt::format("the {} of a frame is unknown when it is to be rendered", what));
}

render::ColorMatrix to_render(ar::ColorMatrix matrix) {
  switch (matrix) {
    case ar::ColorMatrix::Rgb:
      return render::ColorMatrix::Rgb;
    case ar::ColorMatrix::Bt601:
      return render::ColorMatrix::Bt601;
    case ar::ColorMatrix::Bt709:
      return render::ColorMatrix::Bt709;
    case ar::ColorMatrix::Bt2020:
      return render::ColorMatrix::Bt2020;
    case ar::ColorMatrix::Unknown:
      break;
  }
  unknown("colour matrix");
}

render::ColorRange to_render(ar::ColorRange range) {
  switch (range) {
    case ar::ColorRange::Limited:
      return render::ColorRange::Limited;
    case ar::ColorRange::Full:
      return render::ColorRange::Full;
    case ar::ColorRange::Unknown:
      break;
  }
  unknown("colour range");
}

render::Transfer to_render(ar::Transfer transfer) {
  switch (transfer) {
    case ar::Transfer::Bt709:
      return render::Transfer::Bt709;
    case ar::Transfer::Srgb:
      return render::Transfer::Srgb;
    case ar::Transfer::Linear:
      return render::Transfer::Linear;
    case ar::Transfer::Gamma22:
      return render::Transfer::Gamma22;
    case ar::Transfer::Gamma28:
      return render::Transfer::Gamma28;
    case ar::Transfer::Pq:
      return render::Transfer::Pq;
    case ar::Transfer::Hlg:
      return render::Transfer::Hlg;
    case ar::Transfer::Unknown:
      break;
  }
  unknown("transfer function");
}

render::Chroma to_render(ar::Chroma chroma) {
  switch (chroma) {
    case ar::Chroma::C420:
      return render::Chroma::C420;
    case ar::Chroma::C422:
      return render::Chroma::C422;
    case ar::Chroma::C444:
      return render::Chroma::C444;
  }
  unknown("chroma subsampling");
}

render::ChromaSiting to_render(ar::ChromaSiting siting) {
  switch (siting) {
    case ar::ChromaSiting::Left:
      return render::ChromaSiting::Left;
    case ar::ChromaSiting::Center:
      return render::ChromaSiting::Center;
    case ar::ChromaSiting::TopLeft:
      return render::ChromaSiting::TopLeft;
    case ar::ChromaSiting::Unknown:
      break;
  }
  unknown("chroma siting");
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
          .chroma = to_render(format.chroma),
          .siting = to_render(format.color.siting),
          .matrix = to_render(format.color.matrix),
          .range = to_render(format.color.range),
          .transfer = to_render(format.color.transfer)};
}

render::PictureView view_of(const ar::Frame& frame) {
  return {to_render(frame.format), frame.plane, frame.stride_bytes};
}

render::MutablePictureView view_of(const ar::OutputFrame& frame) {
  return {to_render(frame.format), frame.plane, frame.stride_bytes};
}

}  // namespace app
