#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "render/base/picture.h"
#include "render/base/rectangle.h"

namespace render {

// Log2 of how much coarser chroma is than luma, along x and y.
glm::ivec2 chroma_shift(Chroma chroma);

// Samples along x and y of plane 0, 1 or 2.
glm::ivec2 plane_size(const PictureFormat& format, int plane);

// Bytes of one sample: 1 for 8 bits, else 2.
int sample_bytes(const PictureFormat& format);

// The samples of a plane that belong to a rectangle of luma pixels: every sample that one of the pixels falls on.
PixelRect plane_rect(const PictureFormat& format, int plane, const PixelRect& luma_rect);

// Copies of `in` what lies outside `hole`, in luma pixels.
void copy_around(const PictureView& in, const MutablePictureView& out, const PixelRect& hole);

// Throws std::runtime_error that says what is wrong with a format (sizes, depth, transfer).
void check_format(const PictureFormat& format);

}  // namespace render
