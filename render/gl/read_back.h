#pragma once

#include <GLES3/gl31.h>

#include <vector>

namespace render::gl {

// The first channel of a colour-renderable float texture, row 0 first. Waits for the GL; changes the framebuffer.
std::vector<float> read_red(GLuint texture, int width, int height);

}  // namespace render::gl
