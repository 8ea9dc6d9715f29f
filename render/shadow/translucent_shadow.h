#pragma once

#include <vector>

#include "render/gl/framebuffer.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/shadow/sun_shadow.h"

namespace render {

// The map of a scene's glass as the sun sees it: its first depth, and the product of what all of it lets through.
// Nothing is made, drawn or kept where a scene has none.
class TranslucentShadow {
 public:
  // As SunShadow::update().
  bool update(const SceneState& scene, const View& view, int size_px, GpuModels& models);
  const TranslucentMap& map() const { return map_; }
  void bind(const View& view, const gl::Program& program) const;

 private:
  struct Key {
    std::vector<std::pair<const Model*, glm::dmat4>> translucent;
    glm::dvec3 sun_direction{0.0};
    int size_px = 0;
    bool operator==(const Key&) const = default;
  };
  struct Programs {
    gl::Program plain{"shadow/occluder.vert", "shadow/translucent.frag"};
    gl::Program textured{"shadow/occluder.vert", "shadow/translucent.frag", {{"ALPHA_MASK"}}};
  };

  void make_storage(int size_px);
  void draw(const std::vector<const Instance*>& translucent, GpuModels& models);
  void draw_meshes(const std::vector<const Instance*>& translucent, GpuModels& models);

  Key key_;
  TranslucentMap map_;
  std::unique_ptr<Programs> programs_;
  gl::Texture depth_;
  gl::Texture tint_;
  gl::Framebuffer framebuffer_;
};

}  // namespace render
