#pragma once

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <optional>

#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
#include "render/gl/program.h"
#include "render/shafts/shaft_technique.h"

namespace render {

// What a march along view rays looks up: the first occluder of any kind on the light's way, cut to where the medium can
// be shadowed. Made anew when a shadow map or the medium's box has changed.
class OccluderMap {
 public:
  // 1: with the texels of the finer shadow map, up to twice as many across as it has; where there is only one shadow
  // map, that itself. 2: half as many across as the shadow maps, small enough for a processor's caches.
  explicit OccluderMap(int coarseness) : coarseness_(coarseness) {}

  // From those maps. Changes framebuffer, viewport and program when it draws.
  void update(const ShaftInputs& inputs, const SunShadow& maps);
  void update(const ShaftInputs& inputs) { update(inputs, inputs.occluders()); }

  bool empty() const { return empty_; }  // no occluders
  // Sets all that shaders/shafts/occluder_depth.glsl declares; the margins at a ray's end where the program has them.
  void bind(const gl::Program& program, const ShaftInputs& inputs) const;
  // The map alone: occluder_depth and occluder_layer.
  void bind_depth(const gl::Program& program) const;
  glm::ivec2 size_px() const { return size_px_; }
  // (u, v, depth): u and v 0 to 1 inside the map, depth along the light's travel, 0 to 1 where occluders are.
  const glm::dmat4& map_from_world() const { return map_from_world_; }

 private:
  struct Key {
    const SunShadow* maps = nullptr;      // the medium's or the surfaces', by turns
    std::array<unsigned, 2> revisions{};  // of the shadow maps
    glm::dvec3 box_low{0.0};
    glm::dvec3 box_high{0.0};
    bool operator==(const Key&) const = default;
  };

  void place(const ShaftInputs& inputs);
  glm::ivec2 wanted_size() const;
  void draw(const ShaftInputs& inputs);

  Key key_;
  int coarseness_;
  bool made_ = false;
  bool empty_ = true;
  std::optional<Occluders> only_;  // this shadow map stands for all; then nothing is drawn
  glm::ivec2 size_px_{1};
  glm::dmat4 map_from_world_{1.0};
  glm::dvec3 size_m_{1.0};
  gl::LayeredTexture depth_;
  gl::Framebuffer framebuffer_;
  std::map<int, gl::Program> programs_;
  gl::VertexArray no_vertices_;
};

}  // namespace render
