#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/synth/world.h"

namespace app::synth {

namespace {

constexpr float kNever = 1e30F;
constexpr float kFarGroundM = 60.0F;  // beyond it the backdrop has the ground

// (u, v) in metres on a block's face and the face's frame in the block's axes: columns u, v, outward normal.
struct FaceFrame {
  glm::vec2 uv;
  glm::mat3 local_from_face;
};

FaceFrame face_frame(const glm::vec3& local, const glm::vec3& half, const glm::vec3& normal) {
  constexpr float kMiddle = 4.096F;  // the middle of the texture: its seam lies outside blocks up to 8 m
  const glm::vec3 x(1.0F, 0.0F, 0.0F), y(0.0F, 1.0F, 0.0F), z(0.0F, 0.0F, 1.0F);
  if (normal.x != 0.0F) return {{local.y + kMiddle, local.z + half.z}, {y, z, normal}};
  if (normal.y != 0.0F) return {{local.x + kMiddle, local.z + half.z}, {x, z, normal}};
  return {{local.x + kMiddle, local.y + kMiddle}, {x, y, normal}};
}

// 0 to 5; `normal` is along an axis of the block.
int face_number(const glm::vec3& normal) {
  return static_cast<int>(normal.x + 2.0F * normal.y + 3.0F * normal.z) + 3;
}

}  // namespace

// Slab test (Kay & Kajiya 1986) in the block's axes; nearest entry closer than `t`.
bool World::hit_block(const Block& block, const glm::vec3& origin, const glm::vec3& direction, float& t,
                      glm::vec3& normal_local) {
  const glm::vec3 o = (origin - block.centre) * block.world_from_local;  // row vector times matrix: the transpose
  const glm::vec3 d = direction * block.world_from_local;
  const glm::vec3 inverse = 1.0F / d;
  const glm::vec3 a = (-block.half - o) * inverse;
  const glm::vec3 b = (block.half - o) * inverse;
  const glm::vec3 enter = glm::min(a, b);
  const glm::vec3 leave = glm::max(a, b);
  const float first = std::max({enter.x, enter.y, enter.z});
  const float last = std::min({leave.x, leave.y, leave.z});
  if (!(first <= last) || first <= 1e-4F || first >= t) return false;
  t = first;
  normal_local = glm::vec3(0.0F);
  const int axis = first == enter.x ? 0 : first == enter.y ? 1 : 2;
  normal_local[axis] = d[axis] > 0.0F ? -1.0F : 1.0F;
  return true;
}

bool World::hit_card(const Card& card, const glm::vec3& origin, const glm::vec3& direction, float& t,
                     glm::vec2& uv) const {
  const glm::vec2 normal(-card.right.y, card.right.x);
  const float slant = glm::dot(normal, glm::vec2(direction));
  if (std::abs(slant) < 1e-6F) return false;
  const float hit = glm::dot(normal, glm::vec2(card.foot) - glm::vec2(origin)) / slant;
  if (hit <= 1e-3F || hit >= t) return false;
  const glm::vec3 at = origin + direction * hit - card.foot;
  uv = {0.5F + 0.5F * glm::dot(glm::vec2(at), card.right) / card.half_width_m, 1.0F - at.z / card.height_m};
  if (uv.x < 0.0F || uv.x > 1.0F || uv.y < 0.0F || uv.y > 1.0F) return false;
  t = hit;
  return true;
}

float World::sun_seen(const glm::vec3& point, Random& random) const {
  const glm::vec2 at(glm::dot(point, across_sun_), glm::dot(point, above_sun_));
  const glm::vec2 g = (at - grid_low_) / grid_cell_;
  if (!(g.x >= 0.0F && g.y >= 0.0F && g.x < kGrid && g.y < kGrid)) return 1.0F;
  const auto& casters = grid_[static_cast<std::size_t>(static_cast<int>(g.y) * kGrid + static_cast<int>(g.x))];
  if (casters.empty()) return 1.0F;
  const float turn = 2.0F * std::numbers::pi_v<float> * random.next();
  const float radius = light_.sun_radius_rad() * std::sqrt(random.next());
  const glm::vec3 towards =
      light_.sun_direction() + radius * (std::cos(turn) * across_sun_ + std::sin(turn) * above_sun_);
  const float height = glm::dot(point, light_.sun_direction());
  float seen = 1.0F;
  for (const Caster& caster : casters) {
    if (caster.reach_m < height) continue;
    float t = kNever;
    if (!caster.card) {
      glm::vec3 normal;
      if (hit_block(blocks_[caster.index], point, towards, t, normal)) return 0.0F;
      continue;
    }
    glm::vec2 uv;
    const Card& card = shadow_cards_[caster.index];
    if (hit_card(card, point, towards, t, uv)) seen *= 1.0F - card.painting->sample(uv, 1.0F).a;
    if (seen < 0.004F) return 0.0F;
  }
  return seen;
}

// Lambert under sun and sky, and a faint rough mirror (Blinn-Phong lobe with Schlick's Fresnel) for worn stone.
Radiance World::shade(const SurfacePoint& surface, const glm::mat3& frame, const glm::vec3& point,
                      const glm::vec3& to_eye, float sky_open, Random& random) const {
  const glm::vec3 normal = glm::normalize(frame * glm::vec3(surface.slope, 1.0F));
  const float cosine = glm::dot(normal, light_.sun_direction());
  const float above = glm::dot(frame[2], light_.sun_direction());
  const float open = surface.sky_seen * sky_open;
  const glm::vec3 sky = light_.sky_illuminance(normal) * open;
  glm::vec3 out = surface.albedo * sky;
  float lit = 0.0F;
  if (cosine > 0.0F && above > 0.0F && surface.sun_seen > 0.0F) {
    lit = surface.sun_seen * sun_seen(point + 1e-3F * frame[2], random);
    out += surface.albedo * light_.sun_illuminance() * (cosine * lit);
  }
  if (surface.gloss > 0.0F) {
    const glm::vec3 half = glm::normalize(to_eye + light_.sun_direction());
    const auto fresnel = [](float c) {
      const float m = 1.0F - glm::clamp(c, 0.0F, 1.0F);
      return 0.04F + 0.96F * m * m * m * m * m;
    };
    float lobe = std::max(glm::dot(normal, half), 0.0F);
    for (int i = 0; i < 4; ++i) lobe *= lobe;  // to the 16th: (16 + 8) / 8 pi on the projected light
    if (lit > 0.0F)
      out += light_.sun_illuminance() * (surface.gloss * lit * 3.0F * lobe * cosine * fresnel(glm::dot(half, to_eye)));
    out += sky * (0.5F * surface.gloss * fresnel(glm::dot(normal, to_eye) + 0.12F));
  }
  return {.luminance_rgb = out / std::numbers::pi_v<float>, .sun_share = lit};
}

float World::sky_open_at(const glm::vec3& point, const glm::vec3& normal) const {
  const float ground = openness(glm::vec2(point));
  const float height = smooth_ramp(0.0F, 1.6F, point.z);  // what is around matters less higher up
  const float contact = normal.z > 0.5F ? 1.0F : 0.62F + 0.38F * smooth_ramp(-0.05F, 0.45F, point.z);
  return glm::mix(ground, 1.0F, height) * contact;
}

Radiance World::shade_ground(const glm::vec3& point, const glm::vec3& direction, float t, const RayFilter& filter,
                             Random& random) const {
  const float slant = std::max(-direction.z, 1e-3F);
  const float footprint = t * filter.spread_rad / std::sqrt(slant);  // geometric mean of the ellipse's axes
  const glm::vec2 at(point);
  SurfacePoint surface;
  const auto* const part = std::find_if(ground_.parts.begin(), ground_.parts.end(), [&](const auto& candidate) {
    const glm::vec2 local = at - candidate.origin;
    return local.x > 0.0F && local.y > 0.0F && local.x < candidate.texture.metres() &&
           local.y < candidate.texture.metres();
  });
  if (part != ground_.parts.end()) {
    surface = part->texture.sample(at - part->origin, footprint, filter.dither);
  } else {  // slow changes of tone hide that it repeats
    surface = ground_.around.sample(at, footprint, filter.dither);
    surface.albedo *=
        0.70F + 0.42F * value_noise(at * 0.21F, seed_ + 40U) + 0.21F * value_noise(at * 0.83F, seed_ + 41U);
  }
  static const glm::mat3 kLevel(1.0F);
  return shade(surface, kLevel, point, -direction, openness(at), random);
}

Radiance World::shade_block(const Block& block, const glm::vec3& point, const glm::vec3& normal_local,
                            const glm::vec3& direction, float t, const RayFilter& filter, Random& random) const {
  const glm::vec3 local = (point - block.centre) * block.world_from_local;
  const FaceFrame face = face_frame(local, block.half, normal_local);
  const glm::mat3 frame = block.world_from_local * face.local_from_face;
  SurfacePoint surface;
  surface.albedo = glm::vec3(0.55F);
  if (block.surface != nullptr) surface = block.surface->sample(face.uv, t * filter.spread_rad, filter.dither);
  return shade(surface, frame, point, -direction, sky_open_at(point, frame[2]), random);
}

// Matt paper: its white and its black are those of a laser print.
Radiance World::shade_tag(const PrintedTag& tag, const glm::vec3& point, Random& random) const {
  const glm::vec3 local = (point - tag.centre) * tag.world_from_tag;
  SurfacePoint surface;
  surface.albedo = glm::vec3(tag.face.is_white(local.x, local.y) ? 0.78F : 0.045F);
  const glm::mat3 frame(tag.world_from_tag[0], -tag.world_from_tag[1], -tag.world_from_tag[2]);
  return shade(surface, frame, point, -frame[2], sky_open_at(point, frame[2]), random);
}

struct World::Hit {
  enum class On { Backdrop, Ground, Block, Tag } on = On::Backdrop;
  float t = kNever;
  const Block* block = nullptr;
  const PrintedTag* tag = nullptr;
  glm::vec3 normal_local{0.0F};  // of the block
};

World::Hit World::first_solid(const glm::vec3& origin, const glm::vec3& direction, const Candidates& among) const {
  Hit found;
  if (direction.z < 0.0F && -origin.z / direction.z * glm::length(glm::vec2(direction)) < kFarGroundM) {
    found.t = -origin.z / direction.z;
    found.on = Hit::On::Ground;
  }
  for (const std::uint16_t i : among.boxes) {
    if (hit_block(blocks_[i], origin, direction, found.t, found.normal_local)) {
      found.block = &blocks_[i];
      found.on = Hit::On::Block;
    }
  }
  for (const std::uint16_t i : among.tags) {
    const glm::vec3 normal = tags_[i].world_from_tag[2];  // into the tag
    const float facing = glm::dot(normal, direction);
    if (facing <= 1e-6F) continue;
    const float hit = glm::dot(normal, tags_[i].centre - origin) / facing;
    if (hit <= 0.0F || hit > found.t * (1.0F + 1e-5F)) continue;  // a tag that lies in the ground's plane wins
    const glm::vec3 local = (origin + direction * hit - tags_[i].centre) * tags_[i].world_from_tag;
    if (std::max(std::abs(local.x), std::abs(local.y)) > tags_[i].half_side_m) continue;
    found.t = hit;
    found.tag = &tags_[i];
    found.on = Hit::On::Tag;
  }
  return found;
}

// The light of the plants nearer than `t` along the ray; a: the share of what is behind that passes them.
glm::vec4 World::leaves_before(float t, const glm::vec3& origin, const glm::vec3& direction, const RayFilter& filter,
                               const Candidates& among) const {
  struct Veil {
    float t;
    glm::vec4 leaves;
  };
  std::array<Veil, 12> veils;
  std::size_t veil_count = 0;
  for (const std::uint16_t i : among.cards) {
    float hit = t;
    glm::vec2 uv;
    if (veil_count == veils.size() || !hit_card(cards_[i], origin, direction, hit, uv)) continue;
    const glm::vec4 leaves = cards_[i].painting->sample(uv, hit * filter.spread_rad * cards_[i].texels_per_m);
    if (leaves.a <= 0.0F) continue;
    std::size_t place = veil_count++;  // near ones first
    for (; place > 0 && veils[place - 1].t > hit; --place) veils[place] = veils[place - 1];
    veils[place] = {hit, leaves};
  }
  glm::vec3 luminance_rgb(0.0F);
  float through = 1.0F;
  for (std::size_t i = 0; i < veil_count; ++i) {
    luminance_rgb += through * glm::vec3(veils[i].leaves);
    through *= 1.0F - veils[i].leaves.a;
  }
  return {luminance_rgb, through};
}

Radiance World::shade_hit(const Hit& hit, const glm::vec3& origin, const glm::vec3& direction, const RayFilter& filter,
                          Random& random) const {
  const glm::vec3 point = origin + direction * std::min(hit.t, 1e4F);
  Radiance seen;
  switch (hit.on) {
    case Hit::On::Backdrop:
      seen.luminance_rgb = backdrop_.luminance(direction);
      break;
    case Hit::On::Ground:
      seen = shade_ground(point, direction, hit.t, filter, random);
      seen.thing = 0;
      break;
    case Hit::On::Block:
      seen = shade_block(*hit.block, point, hit.normal_local, direction, hit.t, filter, random);
      seen.thing = 1 + 8 * static_cast<int>(hit.block - blocks_.data()) + face_number(hit.normal_local);
      break;
    case Hit::On::Tag:
      seen = shade_tag(*hit.tag, point, random);
      break;
  }
  seen.tag = hit.on == Hit::On::Tag;
  return seen;
}

Radiance World::trace(const glm::vec3& origin, const glm::vec3& direction, const RayFilter& filter,
                      const Candidates& among, Random& random) const {
  const Hit hit = first_solid(origin, direction, among);
  const glm::vec4 leaves = leaves_before(hit.t, origin, direction, filter, among);
  if (leaves.a < 0.003F) {
    Radiance only_leaves;
    only_leaves.luminance_rgb = glm::vec3(leaves);
    return only_leaves;
  }
  Radiance seen = shade_hit(hit, origin, direction, filter, random);
  seen.luminance_rgb = glm::vec3(leaves) + leaves.a * seen.luminance_rgb;
  return seen;
}

}  // namespace app::synth
