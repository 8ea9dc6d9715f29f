#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>

#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
#include "render/gl/program.h"
#include "render/shafts/shaft_technique.h"

namespace render {

// What a march along view rays looks up: the first caster of any kind on the light's way, cut to where the medium can
// be shaded. Half as many texels across as the shadow maps: small enough for a processor's caches, and still finer
// than the pixels of a shaft picture. Made anew when a shadow map or the medium's box has changed.
class CasterMap {
 public:
  // Changes framebuffer, viewport and program when it draws.
  void update(const ShaftInputs& inputs);

  bool empty() const { return empty_; }                  // no casters
  const gl::Texture& texture() const { return depth_; }  // R32F
  // (u, v, depth): u and v 0 to 1 inside the map, depth along the light's travel from 0, before all casters.
  const glm::dmat4& map_from_world() const { return map_from_world_; }

 private:
  struct Key {
    std::array<unsigned, 2> revisions{};  // of the shadow maps
    glm::dvec3 box_low{0.0};
    glm::dvec3 box_high{0.0};
    bool operator==(const Key&) const = default;
  };

  void place(const ShaftInputs& inputs);
  void draw(const ShaftInputs& inputs);

  Key key_;
  bool made_ = false;
  bool empty_ = true;
  glm::dmat4 map_from_world_{1.0};
  gl::Texture depth_;
  gl::Framebuffer framebuffer_;
  std::map<int, gl::Program> programs_;
  gl::VertexArray no_vertices_;
};

}  // namespace render
