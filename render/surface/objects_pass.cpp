#include "render/surface/objects_pass.h"

#include <algorithm>
#include <array>
#include <vector>

#include "render/surface/lighting.h"
#include "render/surface/object_targets.h"
#include "render/surface/sky_mirror.h"
#include "render/surface/surface_programs.h"
#include "render/surface/touched_rect.h"

namespace render {
namespace {

void clear_color(const gl::Framebuffer& framebuffer, float rgb) {
  framebuffer.bind();
  const std::array<GLfloat, 4> color{rgb, rgb, rgb, 1.0F};
  glClearBufferfv(GL_COLOR, 0, color.data());
}

void clear_depth(const gl::Framebuffer& framebuffer) {
  framebuffer.bind();
  constexpr GLfloat kFar = 1.0F;
  glClearBufferfv(GL_DEPTH, 0, &kFar);
}

void scissor(const PixelRect& rect) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(rect.x, rect.y, rect.width, rect.height);
}

// One mesh of one instance.
struct Draw {
  const Instance* instance;
  const GpuModel* model;
  const GpuModel::MeshRange* mesh;

  const Material& material() const { return model->material(mesh->material); }
  const GpuModel::Textures& textures() const { return model->textures(mesh->material); }
};

double distance_m(const Instance& instance, const View& view) {
  const glm::dvec3 middle = 0.5 * (glm::dvec3(instance.model->bounds_min) + glm::dvec3(instance.model->bounds_max));
  return glm::distance(glm::dvec3(instance.world_from_model * glm::dvec4(middle, 1.0)), view.eye_in_world);
}

}  // namespace

struct ObjectsPass::Impl {
  int samples;
  ObjectTargets targets;
  PixelRect dirty;  // what the last frame left in the resolved textures
  PixelRect covered;
  ObjectsPicture picture;
  SurfacePrograms programs;
  gl::Program uncovered_program{"lib/full_screen.vert", "surface/uncovered.frag"};
  gl::VertexArray no_vertices;

  // The frame being drawn.
  const View* view = nullptr;
  const SunShadow* shadow = nullptr;
  Lighting lighting;
  SkyMirror sky_mirror;
  SurfacePrograms::Casts casts;

  Impl(int sample_count, bool quick_shadows) : samples(sample_count > 1 ? sample_count : 0), programs(quick_shadows) {}

  void make_targets() {
    if (targets.width == view->width && targets.height == view->height) return;
    targets = ObjectTargets(view->width, view->height, samples);
    dirty = {0, 0, view->width, view->height};
    picture = {.added = targets.added.id(),
               .multiplier = targets.multiplier.id(),
               .depth = targets.depth.id(),
               .width = view->width,
               .height = view->height,
               .touched = {}};
  }

  // Puts M = 1 and A = 0 back where the last frame drew.
  void wipe() {
    if (dirty.empty()) return;
    scissor(dirty);
    clear_color(targets.added_only, 0.0F);
    clear_color(targets.multiplier_only, 1.0F);
    dirty = {};
  }

  void set_transforms(const gl::Program& program, const Instance& instance) const {
    const glm::dmat4 local_from_model = view->local_from_world() * instance.world_from_model;
    program.set("clip_from_model", glm::mat4(view->clip_from_local() * local_from_model));
    program.set("local_from_model", glm::mat4(local_from_model));
    program.set("local_normal_from_model", glm::mat3(glm::transpose(glm::inverse(glm::dmat3(local_from_model)))));
  }

  void set_light(const gl::Program& program) const {
    lighting.set(program);
    shadow->bind(*view, program);
    if (casts.translucent) shadow->bind_translucent(*view, program);
  }

  void draw_real_depth(const std::vector<Draw>& real) const {
    const gl::Program& program = programs.real_depth();
    program.use();
    for (const Draw& draw : real) {
      set_transforms(program, *draw.instance);
      draw.model->draw(*draw.mesh);
    }
  }

  void draw_real(const gl::Program& program, const std::vector<Draw>& real) const {
    program.use();
    set_light(program);
    program.bind("added", targets.added.handle());
    for (const Draw& draw : real) {
      set_transforms(program, *draw.instance);
      draw.model->draw(*draw.mesh);
    }
  }

  // First marks in the stencil, at little cost, where there may be any: seldom much of the picture.
  void draw_real_shadow(const std::vector<Draw>& real) {
    targets.real_shadow.bind();
    scissor(picture.touched);
    glClearBufferfi(GL_DEPTH_STENCIL, 0, 1.0F, 0);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_real_depth(real);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_EQUAL);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_ALWAYS, 1, 0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    draw_real(programs.real_shadow(casts, true), real);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilFunc(GL_EQUAL, 1, 0xFF);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    draw_real(programs.real_shadow(casts, false), real);
    glDisable(GL_STENCIL_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
  }

  static void set_culling(const Draw& draw) {
    (draw.material().double_sided ? glDisable : glEnable)(GL_CULL_FACE);
    // The picture's y points down in the framebuffer, which turns every triangle round.
    const bool mirrored = glm::determinant(glm::dmat3(draw.instance->world_from_model)) < 0.0;
    glFrontFace(mirrored ? GL_CCW : GL_CW);
  }

  void draw_virtual(SurfacePrograms::Use use, const std::vector<Draw>& draws) {
    for (const Draw& draw : draws) {
      const gl::Program& program = programs.virtual_surface(use, draw.material(), draw.textures(), casts);
      program.use();
      SurfacePrograms::set_material(program, draw.material(), draw.textures());
      if (use == SurfacePrograms::Use::Light || use == SurfacePrograms::Use::MarkedLight) {
        set_light(program);
        sky_mirror.bind(program);
      }
      if (use == SurfacePrograms::Use::SmoothEdges) {
        program.bind("shaded", targets.light.handle());
        program.bind("marks", targets.marks.handle());
        const bool cut_out = is_cut_out(draw.material(), draw.textures());
        (cut_out ? glEnable : glDisable)(GL_SAMPLE_ALPHA_TO_COVERAGE);
        // The target's alpha is what stays uncovered: nothing of it where a mask's alpha made a sample covered.
        (cut_out ? glEnable : glDisable)(GL_BLEND);
        glBlendFuncSeparate(GL_ONE, GL_ZERO, GL_ZERO, GL_ZERO);
      }
      set_transforms(program, *draw.instance);
      set_culling(draw);
      draw.model->draw(*draw.mesh);
    }
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
  }

  // Onto `target`, where the depth of all other virtual things is there already.
  void draw_blended(const gl::Framebuffer& target, const std::vector<Draw>& blended) {
    if (blended.empty()) return;
    target.bind();
    scissor(covered);
    glDepthMask(GL_FALSE);
    for (const Draw& draw : blended) {
      // One after the other: draw_virtual() leaves blending off.
      glEnable(GL_BLEND);
      glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
      draw_virtual(SurfacePrograms::Use::Light, {draw});
    }
    glDepthMask(GL_TRUE);
  }

  // Shades what is nearest in each pixel, and only that, onto the depth that is there.
  void draw_light(const gl::Framebuffer& target, SurfacePrograms::Use use, const std::vector<Draw>& solid) {
    target.bind();
    scissor(covered);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_EQUAL);
    draw_virtual(use, solid);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
  }

  void draw_smooth(const std::vector<Draw>& real, const std::vector<Draw>& solid, const std::vector<Draw>& blended) {
    scissor(covered);
    constexpr std::array<GLfloat, 4> kNone{0.0F, 0.0F, 0.0F, 0.0F};
    targets.lit.bind();
    glClearBufferfv(GL_COLOR, 1, kNone.data());
    draw_light(targets.lit, SurfacePrograms::Use::MarkedLight, solid);
    clear_color(targets.smooth, 0.0F);
    clear_depth(targets.smooth);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_real_depth(real);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    draw_virtual(SurfacePrograms::Use::SmoothEdges, solid);
    draw_blended(targets.smooth, blended);
    gl::blit_color(targets.smooth, 0, targets.added_only, covered.x, covered.y, covered.width, covered.height);
  }

  void cover_multiplier() {
    targets.multiplier_only.bind();
    scissor(covered);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    uncovered_program.use();
    uncovered_program.bind("added", targets.added.handle());
    gl::draw_full_screen(no_vertices);
    glDisable(GL_BLEND);
  }

  void draw(const SceneState& scene, GpuModels& models) {
    std::vector<Draw> real;
    std::vector<Draw> solid;
    std::vector<Draw> blended;
    for (const Instance& instance : scene.instances) {
      const GpuModel& model = models.get(instance.model);
      for (const GpuModel::MeshRange& mesh : model.meshes()) {
        const bool blend = model.material(mesh.material).alpha_mode == AlphaMode::Blend;
        (instance.real ? real : blend ? blended : solid).push_back({&instance, &model, &mesh});
      }
    }
    std::ranges::stable_sort(blended, [this](const Draw& a, const Draw& b) {
      return distance_m(*a.instance, *view) > distance_m(*b.instance, *view);
    });

    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    wipe();
    glDisable(GL_SCISSOR_TEST);
    clear_depth(targets.depth_only);
    draw_real_depth(real);
    dirty = picture.touched;
    if (!covered.empty()) {
      draw_virtual(SurfacePrograms::Use::Depth, solid);
      if (samples > 0) {
        draw_smooth(real, solid, blended);
      } else {
        draw_light(targets.objects, SurfacePrograms::Use::Light, solid);
        draw_blended(targets.objects, blended);
      }
    }
    if (casts.virtual_occluders && !picture.touched.empty()) draw_real_shadow(real);
    if (!covered.empty()) cover_multiplier();
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glFrontFace(GL_CCW);
  }
};

ObjectsPass::ObjectsPass(int samples, bool quick_shadows) : impl_(std::make_unique<Impl>(samples, quick_shadows)) {}
ObjectsPass::~ObjectsPass() = default;

const ObjectsPicture& ObjectsPass::draw(const SceneState& scene, const View& view, const SunShadow& shadow,
                                        GpuModels& models) {
  impl_->view = &view;
  impl_->shadow = &shadow;
  impl_->lighting = lighting_of(scene);
  impl_->sky_mirror.update(scene);
  const bool sun = impl_->lighting.sun_shines();
  impl_->casts = {.virtual_occluders = sun && !shadow.map(Occluders::Virtual).fit.empty,
                  .real_occluders = sun && !shadow.map(Occluders::Real).fit.empty,
                  .translucent = sun && !shadow.translucent().fit.empty};
  impl_->make_targets();
  impl_->covered = covered_rect(scene, view);
  impl_->picture.touched = touched_rect(scene, view);
  impl_->draw(scene, models);
  return impl_->picture;
}

}  // namespace render
