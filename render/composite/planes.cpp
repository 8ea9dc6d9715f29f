#include "render/composite/planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "render/composite/composite_pass.h"

namespace render {
namespace {

// Copies columns [x0, x1) of rows [y0, y1) of one plane.
void copy_samples(const PictureView& in, const MutablePictureView& out, int plane, glm::ivec2 from, glm::ivec2 to) {
  const auto p = static_cast<std::size_t>(plane);
  const int bytes = sample_bytes(in.format);
  if (to.x <= from.x || in.plane[p] == out.plane[p]) return;
  for (int y = from.y; y < to.y; ++y) {
    std::memcpy(out.plane[p] + y * out.stride_bytes[p] + from.x * bytes,
                in.plane[p] + y * in.stride_bytes[p] + from.x * bytes,
                static_cast<std::size_t>((to.x - from.x) * bytes));
  }
}

}  // namespace

glm::ivec2 chroma_shift(Chroma chroma) {
  return {chroma == Chroma::C444 ? 0 : 1, chroma == Chroma::C420 ? 1 : 0};
}

glm::ivec2 plane_size(const PictureFormat& format, int plane) {
  const glm::ivec2 shift = plane == 0 ? glm::ivec2(0) : chroma_shift(format.chroma);
  return (glm::ivec2(format.width, format.height) + (1 << shift) - 1) >> shift;
}

int sample_bytes(const PictureFormat& format) {
  return format.bit_depth > 8 ? 2 : 1;
}

PixelRect plane_rect(const PictureFormat& format, int plane, const PixelRect& luma_rect) {
  const glm::ivec2 shift = plane == 0 ? glm::ivec2(0) : chroma_shift(format.chroma);
  const glm::ivec2 first = glm::ivec2(luma_rect.x, luma_rect.y) >> shift;
  const glm::ivec2 end = glm::min(
      (glm::ivec2(luma_rect.x + luma_rect.width, luma_rect.y + luma_rect.height) + (glm::ivec2(1) << shift) - 1) >>
          shift,
      plane_size(format, plane));
  return {first.x, first.y, end.x - first.x, end.y - first.y};
}

void copy_around(const PictureView& in, const MutablePictureView& out, const PixelRect& hole) {
  for (int plane = 0; plane < 3; ++plane) {
    const glm::ivec2 size = plane_size(in.format, plane);
    if (hole.empty()) {
      copy_samples(in, out, plane, {0, 0}, size);
      continue;
    }
    const PixelRect r = plane_rect(in.format, plane, hole);
    copy_samples(in, out, plane, {0, 0}, {size.x, r.y});
    copy_samples(in, out, plane, {0, r.y}, {r.x, r.y + r.height});
    copy_samples(in, out, plane, {r.x + r.width, r.y}, {size.x, r.y + r.height});
    copy_samples(in, out, plane, {0, r.y + r.height}, size);
  }
}

void copy_picture(const PictureView& in, const MutablePictureView& out) {
  if (in.format != out.format) throw std::logic_error("copy_picture: the pictures' formats differ");
  copy_around(in, out, {});
}

void check_format(const PictureFormat& format) {
  if (format.width <= 0 || format.height <= 0) {
    throw std::runtime_error(fmt::format("a picture of {} x {} pixels", format.width, format.height));
  }
  if (format.bit_depth != 8 && format.bit_depth != 10) {
    throw std::runtime_error(
        fmt::format("pictures of {} bits a sample cannot be composited; 8 and 10 can", format.bit_depth));
  }
  if (format.matrix == ColorMatrix::Rgb && format.chroma != Chroma::C444) {
    throw std::runtime_error("a picture without a colour matrix (RGB) must have all planes of the same size");
  }
}

}  // namespace render
