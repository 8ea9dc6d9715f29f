#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/composite/planes.h"

// A picture that owns its planes; rows are padded as video buffers are.
class Planes {
 public:
  explicit Planes(const render::PictureFormat& format, int row_alignment = 32) : format_(format) {
    for (int p = 0; p < 3; ++p) {
      const glm::ivec2 size = render::plane_size(format, p);
      const int bytes = size.x * render::sample_bytes(format);
      stride_[static_cast<std::size_t>(p)] = (bytes + row_alignment - 1) / row_alignment * row_alignment;
      data_[static_cast<std::size_t>(p)].assign(static_cast<std::size_t>(stride_[static_cast<std::size_t>(p)] * size.y),
                                                0xA5);
    }
  }

  int get(int plane, int x, int y) const {
    const std::uint8_t* at = address(plane, x, y);
    return format_.bit_depth > 8 ? at[0] | (at[1] << 8) : at[0];
  }
  void set(int plane, int x, int y, int code) {
    auto* at = const_cast<std::uint8_t*>(address(plane, x, y));
    at[0] = static_cast<std::uint8_t>(code & 0xFF);
    if (format_.bit_depth > 8) at[1] = static_cast<std::uint8_t>(code >> 8);
  }
  render::PictureView view() const {
    render::PictureView v{.format = format_};
    for (std::size_t p = 0; p < 3; ++p) {
      v.plane[p] = data_[p].data();
      v.stride_bytes[p] = stride_[p];
    }
    return v;
  }
  render::MutablePictureView mutable_view() {
    render::MutablePictureView v{.format = format_};
    for (std::size_t p = 0; p < 3; ++p) {
      v.plane[p] = data_[p].data();
      v.stride_bytes[p] = stride_[p];
    }
    return v;
  }
  const render::PictureFormat& format() const { return format_; }

 private:
  const std::uint8_t* address(int plane, int x, int y) const {
    const auto p = static_cast<std::size_t>(plane);
    return data_[p].data() + y * stride_[p] + x * render::sample_bytes(format_);
  }

  render::PictureFormat format_;
  std::array<std::vector<std::uint8_t>, 3> data_;
  std::array<std::ptrdiff_t, 3> stride_{};
};
