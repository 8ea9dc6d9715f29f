#pragma once

#include <vector>

#include "render/base/picture.h"
#include "render/gl/shader_source.h"

namespace render {

// What of shaders/composite/encode.frag a program for pictures of that format is compiled for, but the layers. Throws
// std::runtime_error for transfer functions of high dynamic range.
gl::Defines encode_defines(const PictureFormat& format);

// One format for each way that samples are packed, sited, transferred or widened.
std::vector<PictureFormat> encoded_formats();

}  // namespace render
