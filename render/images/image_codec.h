#pragma once

#include <cstdint>
#include <span>

#include "render/base/image.h"
#include "render/base/whole_file.h"

namespace render {

// Decodes a PNG or JPEG held in memory to RGBA, 8 bits a channel, row 0 at the top; 16-bit PNGs lose their low bits.
// Colour chunks (gAMA, cICP, iCCP) are left aside, as glTF 2.0 requires of its textures: a material says itself which
// are sRGB and which are linear. Throws std::runtime_error that says what is wrong, without a file's name: the caller
// knows it.
Image decode_image(std::span<const std::uint8_t> bytes);

// `image` as a PNG file's bytes, with alpha only where some pixel is not opaque. Throws std::runtime_error when the
// size is zero or does not fit the pixels.
Bytes encode_png(const Image& image);

// `image` as a JPEG file's bytes, alpha dropped; quality 1...100. Throws as encode_png does.
Bytes encode_jpeg(const Image& image, int quality);

}  // namespace render
