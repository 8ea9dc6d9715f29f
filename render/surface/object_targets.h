#pragma once

#include "render/gl/framebuffer.h"
#include "render/gl/texture.h"

namespace render {

// What the objects pass draws into: everything once a pixel, and again multisampled for smooth edges.
struct ObjectTargets {
  int width = 0;
  int height = 0;
  gl::Texture added;
  gl::Texture multiplier;
  gl::Texture depth;
  gl::Texture real_depth;
  gl::Framebuffer added_only;
  gl::Framebuffer multiplier_only;
  gl::Framebuffer depth_only;
  gl::Framebuffer objects;      // added and depth
  gl::Framebuffer real_shadow;  // multiplier and real_depth
  // With anti-aliasing:
  gl::Texture light;    // of virtual things
  gl::Texture marks;    // to know them by
  gl::Framebuffer lit;  // light, marks and depth
  gl::Renderbuffer smooth_added;
  gl::Renderbuffer smooth_depth;
  gl::Framebuffer smooth;

  ObjectTargets() = default;
  // `samples` 0: no anti-aliasing. Throws std::runtime_error where the driver refuses a format.
  ObjectTargets(int width_px, int height_px, int samples);
};

}  // namespace render
