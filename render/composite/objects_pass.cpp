#include "render/composite/objects_pass.h"

#include <algorithm>
#include <vector>

#include "render/composite/lighting.h"
#include "render/composite/surface_programs.h"
#include "render/composite/touched_rect.h"
#include "render/gl/framebuffer.h"

namespace render {
namespace {

constexpr int kVirtualMapUnit = 8;  // and 9
constexpr int kRealMapUnit = 10;    // and 11

// What the picture is drawn into: multisampled, then resolved.
struct Targets {
  int width = 0;
  int height = 0;
  gl::Renderbuffer drawn_added;
  gl::Renderbuffer drawn_multiplier;
  gl::Renderbuffer drawn_depth;
  gl::Framebuffer drawn;
  gl::Texture added;
  gl::Texture multiplier;
  gl::Texture depth;
  gl::Framebuffer added_only;
  gl::Framebuffer multiplier_only;
  gl::Framebuffer depth_only;

  Targets() = default;
  Targets(int w, int h, int samples)
      : width(w),
        height(h),
        drawn_added(GL_RGBA16F, w, h, samples),
        drawn_multiplier(GL_RGB10_A2, w, h, samples),
        drawn_depth(GL_DEPTH_COMPONENT32F, w, h, samples),
        drawn({&drawn_added, &drawn_multiplier}, &drawn_depth, "objects"),
        added(GL_RGBA16F, w, h, gl::Filter::Linear, 1, "objects added"),
        multiplier(GL_RGB10_A2, w, h, gl::Filter::Linear, 1, "objects multiplier"),
        depth(GL_DEPTH_COMPONENT32F, w, h, gl::Filter::Nearest, 1, "objects depth"),
        added_only({&added}, nullptr, "objects added"),
        multiplier_only({&multiplier}, nullptr, "objects multiplier"),
        depth_only({}, &depth, "objects depth") {}
};

void clear_color(const gl::Framebuffer& framebuffer, float value) {
  framebuffer.bind();
  glClearColor(value, value, value, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
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
  ObjectsPicture picture;
  SurfacePrograms programs;
  gl::Program depth_program{"scene/surface.vert", "scene/depth.frag"};

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
    glEnable(GL_SCISSOR_TEST);
    glScissor(dirty.x, dirty.y, dirty.width, dirty.height);
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
  }

  void draw_real_depth(const std::vector<Draw>& real) const {
    depth_program.use();
    for (const Draw& draw : real) {
      set_transforms(depth_program, *draw.instance);
      draw.model->draw(*draw.mesh);
    }
  }

  void draw_real_shadow(const std::vector<Draw>& real) {
    const gl::Program& program = programs.real_shadow(casts);
    program.use();
    set_light(program);
    for (const Draw& draw : real) {
      set_transforms(program, *draw.instance);
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
    (material.double_sided ? glDisable : glEnable)(GL_CULL_FACE);
    // The picture's y points down in the framebuffer, which turns every triangle round.
    const bool mirrored = glm::determinant(glm::dmat3(draw.instance->world_from_model)) < 0.0;
    glFrontFace(mirrored ? GL_CCW : GL_CW);
    const bool soften = material.alpha_mode == AlphaMode::Mask && samples > 0;
    (soften ? glEnable : glDisable)(GL_SAMPLE_ALPHA_TO_COVERAGE);
    draw.model->draw(*draw.mesh);
  }

  void draw_multisampled(const std::vector<Draw>& real, const std::vector<Draw>& opaque,
                         const std::vector<Draw>& blended) {
    const PixelRect& rect = picture.touched;
    targets.drawn.bind();
    glEnable(GL_SCISSOR_TEST);
    glScissor(rect.x, rect.y, rect.width, rect.height);
    constexpr GLfloat kZero[4]{0, 0, 0, 0};
    constexpr GLfloat kOne[4]{1, 1, 1, 1};
    glClearBufferfv(GL_COLOR, 0, kZero);
    glClearBufferfv(GL_COLOR, 1, kOne);
    glClearBufferfv(GL_DEPTH, 0, kOne);

    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_real_depth(real);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (const Draw& draw : opaque) draw_object(draw);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    glDepthMask(GL_FALSE);
    if (casts.virtual_casters && !real.empty()) draw_real_shadow(real);
    if (!blended.empty()) {
      glEnable(GL_BLEND);
      glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
      for (const Draw& draw : blended) draw_object(draw);
      glDisable(GL_BLEND);
    }
    glDepthMask(GL_TRUE);
    SunShadow::unbind(kVirtualMapUnit);
    SunShadow::unbind(kRealMapUnit);
  }

  void resolve() {
    const PixelRect& r = picture.touched;
    gl::blit_color(targets.drawn, 0, targets.added_only, r.x, r.y, r.width, r.height);
    gl::blit_color(targets.drawn, 1, targets.multiplier_only, r.x, r.y, r.width, r.height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, targets.drawn.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, targets.depth_only.id());
    glBlitFramebuffer(r.x, r.y, r.x + r.width, r.y + r.height, r.x, r.y, r.x + r.width, r.y + r.height,
                      GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    dirty = r;
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
    if (!picture.touched.empty()) {
      draw_multisampled(real, opaque, blended);
      resolve();
    }
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
  impl_->picture.touched = touched_rect(scene, view);
  impl_->draw(scene, models);
  return impl_->picture;
}

}  // namespace render
