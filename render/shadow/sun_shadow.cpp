#include "render/shadow/sun_shadow.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
#include "render/gl/layered_texture.h"
#include "render/gl/sampler.h"
#include "render/shadow/depth_bounds.h"
#include "render/shadow/translucent_shadow.h"

namespace render {
namespace {

// What a map was rendered from, to tell whether anything changed since.
struct OccluderKey {
  const Model* model = nullptr;
  glm::dmat4 world_from_model{1.0};
  bool operator==(const OccluderKey&) const = default;
};

std::vector<OccluderKey> keys_of(const std::vector<const Instance*>& occluders) {
  std::vector<OccluderKey> keys;
  for (const Instance* occluder : occluders) keys.push_back({occluder->model.get(), occluder->world_from_model});
  return keys;
}

glm::dvec2 texel_m(const ShadowMap& map) {
  return glm::dvec2(map.fit.metres_per_unit) / static_cast<double>(map.size_px);
}

// How far down the light, in metres, receivers of a map's shadow lie: its occluders' depth, and half of it beyond them.
double shadow_length_m(const ShadowMap& map) {
  return 1.5 * map.fit.metres_per_unit.z;
}

// A medium does with 16 bits of depth, half the memory to read, where a step of it is a small part of a texel.
GLenum part_format(const ShadowFit& part, int size_px) {
  const double texel_m = std::min(part.metres_per_unit.x, part.metres_per_unit.y) / size_px;
  const double step_m = part.metres_per_unit.z / 65535.0;
  return step_m < 0.25 * texel_m ? GL_DEPTH_COMPONENT16 : GL_DEPTH_COMPONENT32F;
}

// Whether the sun has moved its shadows by less than a quarter of a texel, which the bilinear comparison and any
// penumbra hide: a clip's sun moves 73 microradians a second.
bool sun_stands(const ShadowMap& map, const glm::dvec3& rendered, const glm::dvec3& now) {
  if (rendered == now) return true;
  if (map.fit.empty) return false;
  const double texel = std::min(texel_m(map).x, texel_m(map).y);
  return glm::distance(rendered, now) * shadow_length_m(map) < 0.25 * texel;
}

}  // namespace

struct SunShadow::Impl {
  struct Slot {
    gl::Framebuffer framebuffer;
    ShadowMap map;
    std::vector<OccluderKey> keys;
    std::vector<OccluderPiece> left_out;  // of the fit
    glm::dvec3 sun_direction{0.0};
    double disc_slope = 0.0;
    bool rendered = false;
    unsigned whole_revision = 0;  // of the map that this one is a part of
  };

  gl::Program opaque{"shadow/occluder.vert", "shadow/occluder.frag"};
  gl::Program masked{"shadow/occluder.vert", "shadow/occluder.frag", {{"ALPHA_MASK"}}};
  gl::VertexArray no_vertices;
  gl::Sampler plain = gl::Sampler::plain();
  gl::LayeredTexture depth;  // a layer for each kind of occluders that there is
  std::array<bool, kOccluderKinds.size()> has_layer{};
  DepthBounds bounds;
  std::array<Slot, kOccluderKinds.size()> slots;
  TranslucentShadow translucent;

  Slot& slot(Occluders kind) { return slots[static_cast<std::size_t>(kind)]; }

  // Layers of that size for the kinds that there are; all is to be rendered anew where they change.
  void make_storage(const std::array<bool, kOccluderKinds.size()>& there, int size, GLenum format) {
    const int layers = static_cast<int>(std::ranges::count(there, true));
    if (layers == 0) return;
    const bool same = depth.width() == size && depth.internal_format() == format && depth.layers() == layers;
    if (same && there == has_layer) return;
    has_layer = there;
    int next = 0;
    for (std::size_t i = 0; i < slots.size(); ++i) slots[i].map.layer = there[i] ? next++ : 0;
    if (!same) {
      depth = gl::LayeredTexture(gl::LayeredTexture::Kind::Array, format, size, size, layers, gl::Filter::Nearest,
                                 "sun shadow");
      depth.set_depth_compare();
    }
    for (std::size_t i = 0; i < slots.size(); ++i) {
      slots[i].rendered = false;
      slots[i].framebuffer = there[i] ? gl::Framebuffer(depth, slots[i].map.layer, "sun shadow") : gl::Framebuffer();
    }
  }

  bool update(Slot& slot, const SceneState& scene, const View& view, const std::vector<const Instance*>& occluders,
              int size_px, GpuModels& models) {
    const int size = occluders.empty() ? 1 : size_px;
    const std::vector<OccluderKey> keys = keys_of(occluders);
    const double disc_slope = std::tan(sun_of(scene).angular_radius_rad);
    // The disc's size follows the earth's distance from the sun, by some 1e-10 of it in a frame.
    const bool same =
        slot.rendered && keys == slot.keys && slot.map.size_px == size &&
        (occluders.empty() || (sun_stands(slot.map, slot.sun_direction, sun_of(scene).direction_in_world) &&
                               std::abs(slot.disc_slope - disc_slope) <= 1e-6 * disc_slope));
    const std::vector<OccluderPiece> left_out =
        pieces_before_their_shadow(occluders, sun_of(scene).direction_in_world, view.eye_in_world);
    if (same && !slot.map.fit.cut && left_out == slot.left_out) return false;
    const ShadowFit fit = fit_shadow(scene, view, occluders, size, FitTo::Occluders, left_out);
    slot.left_out = left_out;
    if (same && fit == slot.map.fit) return false;
    slot.keys = keys;
    slot.disc_slope = disc_slope;
    slot.sun_direction = sun_of(scene).direction_in_world;
    render(slot, fit, size, occluders, models);
    if (!fit.empty) bound(slot);
    return true;
  }

  // Of the map in `whole`.
  bool update_part(Slot& slot, const Slot& whole, const ShadowFit& part, const std::vector<const Instance*>& occluders,
                   GpuModels& models) {
    if (slot.rendered && slot.whole_revision == whole.map.revision && slot.map.fit == part &&
        slot.map.size_px == whole.map.size_px) {
      return false;
    }
    slot.whole_revision = whole.map.revision;
    slot.left_out = whole.left_out;
    render(slot, part, whole.map.size_px, occluders, models);
    return true;
  }

  void render(Slot& slot, const ShadowFit& fit, int size, const std::vector<const Instance*>& occluders,
              GpuModels& models) {
    slot.map.fit = fit;
    slot.map.size_px = size;
    slot.rendered = true;
    ++slot.map.revision;
    if (!fit.empty) draw(slot, occluders, models);
  }

  void draw(Slot& slot, const std::vector<const Instance*>& occluders, GpuModels& models) {
    slot.framebuffer.bind();
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glClearDepthf(1.0F);
    glDisable(GL_SCISSOR_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    // What lies beside the map must not be taken to go on there from the texels at its edge: those stay lit.
    if (!slot.left_out.empty()) {
      glEnable(GL_SCISSOR_TEST);
      glScissor(1, 1, slot.map.size_px - 2, slot.map.size_px - 2);
    }
    const glm::dmat4 clip_from_map =
        glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0)) * glm::scale(glm::dmat4(1.0), glm::dvec3(2.0));
    for (const Instance* occluder : occluders) {
      const glm::mat4 clip_from_model(clip_from_map * slot.map.fit.map_from_world * occluder->world_from_model);
      opaque.set("map_clip_from_model", clip_from_model);
      masked.set("map_clip_from_model", clip_from_model);
      const GpuModel& model = models.get(occluder->model);
      for (const GpuModel::MeshRange& mesh : model.meshes()) {
        if (model.material(mesh.material).alpha_mode == AlphaMode::Blend) continue;  // GlassShadow's
        use_program_for(model, mesh.material);
        model.draw(mesh);
      }
    }
    glDisable(GL_SCISSOR_TEST);
  }

  // As far around as the search for blockers reaches (visibility.glsl).
  void bound(const Slot& slot) {
    const glm::dvec2 texel = texel_m(slot.map);
    const double search_m = slot.disc_slope * shadow_length_m(slot.map);
    bounds.update(depth, slot.map.layer, plain, no_vertices, search_m / std::min(texel.x, texel.y) + 2.0);
  }

  void use_program_for(const GpuModel& model, int index) {
    const Material& material = model.material(index);
    const gl::Texture* base_color = model.textures(index).base_color;
    if (material.alpha_mode == AlphaMode::Opaque || base_color == nullptr) {
      opaque.use();
      return;
    }
    masked.use();
    masked.set("base_alpha", material.base_color.a);
    masked.set("alpha_cutoff", material.alpha_cutoff);
    masked.bind("base_color_texture", base_color->handle());
  }
};

SunShadow::SunShadow() : impl_(std::make_unique<Impl>()) {}
SunShadow::~SunShadow() = default;

bool SunShadow::update(const SceneState& scene, const View& view, int size_px, GpuModels& models) {
  std::array<std::vector<const Instance*>, kOccluderKinds.size()> all;
  std::array<bool, kOccluderKinds.size()> there{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = occluders(scene, kOccluderKinds[i]);
    there[i] = !all[i].empty();
  }
  impl_->make_storage(there, size_px, GL_DEPTH_COMPONENT32F);
  bool drawn = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    drawn |= impl_->update(impl_->slots[i], scene, view, all[i], size_px, models);
  }
  drawn |= impl_->translucent.update(scene, view, size_px, models);
  return drawn;
}

bool SunShadow::update_parts(const SunShadow& whole, const std::array<ShadowFit, 2>& parts, const SceneState& scene,
                             GpuModels& models) {
  std::array<bool, kOccluderKinds.size()> there{};
  int size_px = 1;
  GLenum format = GL_DEPTH_COMPONENT16;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    there[i] = !parts[i].empty;
    if (!there[i]) continue;
    size_px = whole.impl_->slots[i].map.size_px;
    if (part_format(parts[i], size_px) != format) format = GL_DEPTH_COMPONENT32F;
  }
  impl_->make_storage(there, size_px, format);
  bool drawn = false;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::vector<const Instance*> all = occluders(scene, kOccluderKinds[i]);
    drawn |= impl_->update_part(impl_->slots[i], whole.impl_->slots[i], parts[i], all, models);
  }
  return drawn;
}

const ShadowMap& SunShadow::map(Occluders kind) const {
  return impl_->slot(kind).map;
}

const TranslucentMap& SunShadow::translucent() const {
  return impl_->translucent.map();
}

void SunShadow::bind_translucent(const View& view, const gl::Program& program) const {
  impl_->translucent.bind(view, program);
}

void SunShadow::bind(const View& view, const gl::Program& program) const {
  if (impl_->depth.layers() == 0) return;  // nothing has ever cast a shadow
  program.bind("shadow_compared", impl_->depth.handle());
  program.bind("shadow_depth", impl_->depth.handle(), &impl_->plain);
  program.bind("shadow_bounds", impl_->bounds.texture().handle());
  for (std::size_t i = 0; i < impl_->slots.size(); ++i) {
    const ShadowMap& map = impl_->slots[i].map;
    if (map.fit.empty) continue;
    const auto set = [&](const char* member, const auto& value) {
      program.set(fmt::format("shadow_maps[{}].{}", i, member), value);
    };
    const glm::dmat4 map_from_local = map.fit.map_from_world * glm::inverse(view.local_from_world());
    set("map_from_local", glm::mat4(map_from_local));
    set("local_from_map", glm::mat3(glm::inverse(glm::dmat3(map_from_local))));
    set("metres_per_unit", glm::vec3(map.fit.metres_per_unit));
    set("texel", 1.0F / static_cast<float>(map.size_px));
    set("reach", impl_->bounds.reach_texels(map.layer) / static_cast<float>(map.size_px));
    set("layer", static_cast<float>(map.layer));
  }
}

void SunShadow::bind_depth(const gl::Program& program, std::string_view sampler) const {
  program.bind(sampler, impl_->depth.handle(), &impl_->plain);
}

}  // namespace render
