#include "render/surface/object_targets.h"

namespace render {

ObjectTargets::ObjectTargets(int width_px, int height_px, int samples)
    : width(width_px),
      height(height_px),
      added(GL_RGBA16F, width, height, gl::Filter::Linear, 1, "objects added"),
      multiplier(GL_RGB10_A2, width, height, gl::Filter::Linear, 1, "objects multiplier"),
      depth(GL_DEPTH_COMPONENT32F, width, height, gl::Filter::Nearest, 1, "objects depth"),
      real_depth(GL_DEPTH32F_STENCIL8, width, height, gl::Filter::Nearest, 1, "real depth"),
      added_only({&added}, nullptr, "objects added"),
      multiplier_only({&multiplier}, nullptr, "objects multiplier"),
      depth_only({}, &depth, "objects depth"),
      objects({&added}, &depth, "objects"),
      real_shadow({&multiplier}, &real_depth, "shadow on real things") {
  if (samples == 0) return;
  light = gl::Texture(GL_RGBA16F, width, height, gl::Filter::Nearest, 1, "objects light");
  marks = gl::Texture(GL_R32F, width, height, gl::Filter::Nearest, 1, "objects marks");
  lit = gl::Framebuffer({&light, &marks}, &depth, "objects light");
  smooth_added = gl::Renderbuffer(GL_RGBA16F, width, height, samples);
  smooth_depth = gl::Renderbuffer(GL_DEPTH_COMPONENT32F, width, height, samples);
  smooth = gl::Framebuffer({&smooth_added}, &smooth_depth, "smooth objects");
}

}  // namespace render
