#include "render/gl/sampler.h"

namespace render::gl {

Sampler Sampler::plain() {
  Sampler sampler;
  glSamplerParameteri(sampler.id_, GL_TEXTURE_COMPARE_MODE, GL_NONE);
  glSamplerParameteri(sampler.id_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glSamplerParameteri(sampler.id_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glSamplerParameteri(sampler.id_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(sampler.id_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return sampler;
}

}  // namespace render::gl
