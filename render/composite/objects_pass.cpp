#include "render/composite/objects_pass.h"

#include <algorithm>
#include <vector>

#include "render/composite/lighting.h"
#include "render/composite/surface_programs.h"
#include "render/composite/touched_rect.h"
#include "render/gl/framebuffer.h"

namespace render {
namespace {

constexpr int kVirtualMapUnit = 8;  // and 9; its bounds 10
constexpr int kRealMapUnit = 11;    // and 12; its bounds 13

// What the picture is drawn into: virtual things multisampled, then resolved; real ones as they come.
struct Targets {
  int width = 0;
  int height = 0;
  gl::Renderbuffer drawn_added;
  gl::Renderbuffer drawn_depth;
  gl::Framebuffer drawn;
  gl::Texture added;
  gl::Texture multiplier;
  gl::Texture depth;
  gl::Framebuffer added_only;
  gl::Framebuffer multiplier_only;
  gl::Framebuffer real;  // multiplier and depth
  gl::Framebuffer depth_only;

  Targets() = default;
  Targets(int w, int h, int samples)
      : width(w),
        height(h),
        drawn_added(GL_RGBA16F, w, h, samples),
        drawn_depth(GL_DEPTH_COMPONENT32F, w, h, samples),
        drawn({&drawn_added}, &drawn_depth, "objects"),
        added(GL_RGBA16F, w, h, gl::Filter::Linear, 1, "objects added"),
        multiplier(GL_RGB10_A2, w, h, gl::Filter::Linear, 1, "objects multiplier"),
        depth(GL_DEPTH_COMPONENT32F, w, h, gl::Filter::Nearest, 1, "objects depth"),
        added_only({&added}, nullptr, "objects added"),
        multiplier_only({&multiplier}, nullptr, "objects multiplier"),
        real({&multiplier}, &depth, "shadow on real things"),
        depth_only({}, &depth, "objects depth") {}
};

void clear_color(const gl::Framebuffer& framebuffer, float rgb) {
  framebuffer.bind();
  glClearColor(rgb, rgb, rgb, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
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
};

double distance_m(const Instance& instance, const View& view) {
  const glm::dvec3 middle = 0.5 * (glm::dvec3(instance.model->bounds_min) + glm::dvec3(instance.model->bounds_max));
  return glm::distance(glm::dvec3(instance.world_from_model * glm::dvec4(middle, 1.0)), view.eye_in_world);
}

}  // namespace

struct ObjectsPass::Impl {
  int samples;
  Targets targets;
  PixelRect dirty;  // what the last frame left in the resolved textures
  PixelRect covered;
  ObjectsPicture picture;
  SurfacePrograms programs;
  gl::Program depth_program{"scene/surface.vert", "scene/depth.frag"};
  gl::Program uncovered_program{"lib/full_screen.vert", "scene/uncovered.frag"};
  gl::VertexArray no_vertices;

  // The frame being drawn.
  const View* view = nullptr;
  const SunShadow* shadow = nullptr;
  Lighting lighting;
  SurfacePrograms::Casts casts;

  explicit Impl(int sample_count) : samples(sample_count > 1 ? sample_count : 0) {}

  void make_targets() {
    if (targets.width == view->width && targets.height == view->height) return;
    targets = Targets(view->width, view->height, samples);
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
    shadow->bind(Casters::Virtual, *view, program, kVirtualMapUnit);
    shadow->bind(Casters::Real, *view, program, kRealMapUnit);
    shadow->bind_bounds(Casters::Virtual, program, kVirtualMapUnit + 2);
    shadow->bind_bounds(Casters::Real, program, kRealMapUnit + 2);
  }

  void draw_real_depth(const std::vector<Draw>& real) const {
    depth_program.use();
    for (const Draw& draw : real) {
      set_transforms(depth_program, *draw.instance);
      draw.model->draw(*draw.mesh);
    }
  }

  // Onto the real depth that is there already.
  void draw_real_shadow(const std::vector<Draw>& real) {
    targets.real.bind();
    scissor(picture.touched);
    glDepthMask(GL_FALSE);
    const gl::Program& program = programs.real_shadow(casts);
    program.use();
    set_light(program);
    for (const Draw& draw : real) {
      set_transforms(program, *draw.instance);
      draw.model->draw(*draw.mesh);
    }
    glDepthMask(GL_TRUE);
  }

  static void set_culling(const Draw& draw) {
    (draw.material().double_sided ? glDisable : glEnable)(GL_CULL_FACE);
    // The picture's y points down in the framebuffer, which turns every triangle round.
    const bool mirrored = glm::determinant(glm::dmat3(draw.instance->world_from_model)) < 0.0;
    glFrontFace(mirrored ? GL_CCW : GL_CW);
  }

  // So that what is hidden is not shaded. Not for cut-out things: their depth depends on their alpha.
  void draw_opaque_depth(const std::vector<Draw>& opaque) const {
    depth_program.use();
    for (const Draw& draw : opaque) {
      if (draw.material().alpha_mode != AlphaMode::Opaque) continue;
      set_culling(draw);
      set_transforms(depth_program, *draw.instance);
      draw.model->draw(*draw.mesh);
    }
  }

  void draw_object(const Draw& draw) {
    const Material& material = draw.material();
    const GpuModel::Textures& textures = draw.model->textures(draw.mesh->material);
    const gl::Program& program = programs.object(material, textures, casts);
    program.use();
    set_light(program);
    SurfacePrograms::set_material(program, material, textures);
    set_transforms(program, *draw.instance);
    set_culling(draw);
    const bool mask = material.alpha_mode == AlphaMode::Mask;
    (mask && samples > 0 ? glEnable : glDisable)(GL_SAMPLE_ALPHA_TO_COVERAGE);
    // The target's alpha is what stays uncovered: nothing of it where a mask's alpha made a sample covered.
    (mask || material.alpha_mode == AlphaMode::Blend ? glEnable : glDisable)(GL_BLEND);
    glBlendFuncSeparate(GL_ONE, mask ? GL_ZERO : GL_ONE_MINUS_SRC_ALPHA, GL_ZERO,
                        mask ? GL_ZERO : GL_ONE_MINUS_SRC_ALPHA);
    draw.model->draw(*draw.mesh);
  }

  void draw_multisampled(const std::vector<Draw>& real, const std::vector<Draw>& opaque,
                         const std::vector<Draw>& blended) {
    targets.drawn.bind();
    scissor(covered);
    constexpr GLfloat kUncovered[4]{0, 0, 0, 1};
    constexpr GLfloat kFar = 1.0F;
    glClearBufferfv(GL_COLOR, 0, kUncovered);
    glClearBufferfv(GL_DEPTH, 0, &kFar);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_real_depth(real);
    draw_opaque_depth(opaque);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (const Draw& draw : opaque) draw_object(draw);
    glDepthMask(GL_FALSE);
    for (const Draw& draw : blended) draw_object(draw);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  }

  void resolve() {
    const PixelRect& r = covered;
    gl::blit_color(targets.drawn, 0, targets.added_only, r.x, r.y, r.width, r.height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, targets.drawn.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, targets.depth_only.id());
    glBlitFramebuffer(r.x, r.y, r.x + r.width, r.y + r.height, r.x, r.y, r.x + r.width, r.y + r.height,
                      GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  }

  void cover_multiplier() {
    targets.multiplier_only.bind();
    scissor(covered);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    uncovered_program.use();
    uncovered_program.set("added", 0);
    targets.added.bind(0);
    gl::draw_full_screen(no_vertices);
    glDisable(GL_BLEND);
  }

  void draw(const SceneState& scene, GpuModels& models) {
    std::vector<Draw> real;
    std::vector<Draw> opaque;
    std::vector<Draw> blended;
    for (const Instance& instance : scene.instances) {
      const GpuModel& model = models.get(instance.model);
      for (const GpuModel::MeshRange& mesh : model.meshes()) {
        const bool blend = model.material(mesh.material).alpha_mode == AlphaMode::Blend;
        (instance.real ? real : blend ? blended : opaque).push_back({&instance, &model, &mesh});
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
    targets.depth_only.bind();
    glClearDepthf(1.0F);
    glClear(GL_DEPTH_BUFFER_BIT);
    draw_real_depth(real);
    dirty = picture.touched;
    if (casts.virtual_casters && !picture.touched.empty()) draw_real_shadow(real);
    if (!covered.empty()) {
      draw_multisampled(real, opaque, blended);
      resolve();
      cover_multiplier();
    }
    SunShadow::unbind(kVirtualMapUnit);
    SunShadow::unbind(kRealMapUnit);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glFrontFace(GL_CCW);
  }
};

ObjectsPass::ObjectsPass(int samples) : impl_(std::make_unique<Impl>(samples)) {}
ObjectsPass::~ObjectsPass() = default;

const ObjectsPicture& ObjectsPass::draw(const SceneState& scene, const View& view, const SunShadow& shadow,
                                        GpuModels& models) {
  impl_->view = &view;
  impl_->shadow = &shadow;
  impl_->lighting = lighting_of(scene);
  const bool sun = impl_->lighting.sun_shines();
  impl_->casts = {.virtual_casters = sun && !shadow.map(Casters::Virtual).fit.empty,
                  .real_casters = sun && !shadow.map(Casters::Real).fit.empty};
  impl_->make_targets();
  impl_->covered = covered_rect(scene, view);
  impl_->picture.touched = touched_rect(scene, view);
  impl_->draw(scene, models);
  return impl_->picture;
}

}  // namespace render
