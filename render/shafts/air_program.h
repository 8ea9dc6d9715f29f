#pragma once

#include <map>
#include <string>

#include "render/gl/program.h"
#include "render/shafts/shaft_technique.h"

namespace render {

// A fragment shader over shaders/shafts/ray.glsl in the variants that media and views ask for (NO_DEPTH, DIVIDED,
// BOUNDED, FALLOFF), each made when first used.
class AirProgram {
 public:
  explicit AirProgram(std::string fragment_path, gl::Defines defines = {})
      : path_(std::move(fragment_path)), defines_(std::move(defines)) {}

  // In use, with all that ray.glsl, view_depth.glsl and shade.glsl need for a picture of that size, on texture unit 0.
  const gl::Program& use(const ShaftInputs& inputs, const glm::ivec2& size_px);

 private:
  std::string path_;
  gl::Defines defines_;
  std::map<int, gl::Program> variants_;
};

}  // namespace render
