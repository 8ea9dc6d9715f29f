#include "render/shadow/translucent_shadow.h"

#include <array>
#include <glm/gtc/matrix_transform.hpp>

namespace render {
namespace {

// Panes are even: a map finer than this gains nothing that the light's own blur would show.
constexpr int kLargestMap = 2048;

}  // namespace

bool TranslucentShadow::update(const SceneState& scene, const View& view, int size_px, GpuModels& models) {
  const std::vector<const Instance*> translucent = translucent_occluders(scene);
  if (translucent.empty()) {
    map_ = {};
    key_ = {};
    return false;
  }
  Key key{
      .translucent = {}, .sun_direction = sun_of(scene).direction_in_world, .size_px = std::min(size_px, kLargestMap)};
  for (const Instance* pane : translucent) key.translucent.emplace_back(pane->model.get(), pane->world_from_model);
  const bool same = key == key_;
  if (same && !map_.fit.cut) return false;
  const ShadowFit fit = fit_shadow(scene, view, translucent, key.size_px, FitTo::Translucent);
  if (same && fit == map_.fit) return false;
  key_ = std::move(key);
  make_storage(key_.size_px);
  map_ = {.size_px = key_.size_px, .fit = fit};
  if (!fit.empty) draw(translucent, models);
  return true;
}

void TranslucentShadow::make_storage(int size_px) {
  if (!programs_) programs_ = std::make_unique<Programs>();
  if (map_.size_px == size_px && depth_.width() == size_px) return;
  depth_ = gl::Texture(GL_DEPTH_COMPONENT32F, size_px, size_px, gl::Filter::Nearest, 1, "glass depth");
  tint_ = gl::Texture(GL_RGBA8, size_px, size_px, gl::Filter::Linear, 1, "glass tint");
  framebuffer_ = gl::Framebuffer({&tint_}, &depth_, "glass");
}

// Twice: the first pane's depth, then the product of all panes.
void TranslucentShadow::draw(const std::vector<const Instance*>& translucent, GpuModels& models) {
  framebuffer_.bind();
  glDisable(GL_CULL_FACE);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  constexpr std::array<GLfloat, 4> kClear{1.0F, 1.0F, 1.0F, 1.0F};
  constexpr GLfloat kFar = 1.0F;
  glClearBufferfv(GL_COLOR, 0, kClear.data());
  glClearBufferfv(GL_DEPTH, 0, &kFar);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw_meshes(translucent, models);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  draw_meshes(translucent, models);
  glDisable(GL_BLEND);
}

void TranslucentShadow::draw_meshes(const std::vector<const Instance*>& translucent, GpuModels& models) {
  const glm::dmat4 clip_from_map =
      glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0)) * glm::scale(glm::dmat4(1.0), glm::dvec3(2.0));
  for (const Instance* pane : translucent) {
    const glm::mat4 clip_from_model(clip_from_map * map_.fit.map_from_world * pane->world_from_model);
    const GpuModel& model = models.get(pane->model);
    for (const GpuModel::MeshRange& mesh : model.meshes()) {
      const Material& material = model.material(mesh.material);
      if (material.alpha_mode != AlphaMode::Blend) continue;
      const gl::Texture* base_color = model.textures(mesh.material).base_color;
      const gl::Program& program = base_color == nullptr ? programs_->plain : programs_->textured;
      program.use();
      program.set("map_clip_from_model", clip_from_model);
      program.set("base_color", material.base_color);
      if (base_color != nullptr) {
        program.bind("base_color_texture", base_color->handle());
      }
      model.draw(mesh);
    }
  }
}

void TranslucentShadow::bind(const View& view, const gl::Program& program) const {
  if (map_.fit.empty) return;
  program.bind("translucent_depth", depth_.handle());
  program.bind("translucent_tint", tint_.handle());
  program.set("translucent_map_from_local", glm::mat4(map_.fit.map_from_world * glm::inverse(view.local_from_world())));
  // A pane does not tint itself: not what is nearer behind it than this.
  program.set("translucent_bias", static_cast<float>(0.01 / map_.fit.metres_per_unit.z));
}

}  // namespace render
