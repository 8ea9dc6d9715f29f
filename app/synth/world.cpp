#include "app/synth/world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/synth/parallel.h"

namespace app::synth {

namespace {

glm::mat3 to_glm(const cv::Matx33d& m) {
  glm::mat3 out;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) out[column][row] = static_cast<float>(m(row, column));
  return out;
}

glm::mat3 turned(double heading_rad) {  // clockwise seen from above
  const auto c = static_cast<float>(std::cos(heading_rad));
  const auto s = static_cast<float>(std::sin(heading_rad));
  return {glm::vec3(c, -s, 0.0F), glm::vec3(s, c, 0.0F), glm::vec3(0.0F, 0.0F, 1.0F)};
}

bool in_cone(const glm::vec3& apex, const glm::vec3& axis, float half_angle_rad, const glm::vec3& centre,
             float radius) {
  const glm::vec3 to = centre - apex;
  const float distance = glm::length(to);
  if (distance <= radius) return true;
  const float apart = std::acos(glm::clamp(glm::dot(to, axis) / distance, -1.0F, 1.0F));
  return apart <= half_angle_rad + std::asin(radius / distance);
}

}  // namespace

World::World(const Spec& spec, const glm::vec3& eye, const glm::vec3& focus, const Gaze& gaze)
    : light_(spec),
      ground_(bake_ground(spec.ground, glm::vec2(eye), glm::vec2(focus), light_.sun_direction(), gaze, spec.seed)),
      seed_(spec.seed),
      backdrop_(spec, light_, gaze) {
  add_boxes(spec);
  add_tags(spec);
  add_plants(spec, eye);
  build_shadow_grid();
  bake_openness(glm::vec2(focus));
}

void World::add_boxes(const Spec& spec) {
  for (const BoxSpec& box : spec.boxes) {
    auto [surface, fresh] = surfaces_.try_emplace(box.surface);
    if (fresh) surface->second = bake_box_surface(box.surface, spec.seed);
    blocks_.push_back({glm::vec3(box.position), glm::vec3(0.5 * box.size), turned(box.heading_rad), &surface->second});
  }
}

// A tag is printed on a board of 5 mm, whose face is the tag's plane.
void World::add_tags(const Spec& spec) {
  constexpr float kBoard = 0.005F;
  for (const auto& [id, mapped] : spec.tags.tags) {
    PrintedTag tag;
    const cv::Vec3d& place = mapped.world_from_tag.translation;
    tag.centre = glm::vec3(place[0], place[1], place[2]);
    tag.world_from_tag = to_glm(mapped.world_from_tag.rotation);
    tag.face = ar::make_tag_face(spec.tags.family, id, mapped.size_m);
    tag.half_side_m = static_cast<float>(0.5 * tag.face.side_m());
    const glm::vec3 behind = tag.world_from_tag[2] * (0.5F * kBoard + 1e-4F);
    blocks_.push_back(
        {tag.centre + behind, glm::vec3(tag.half_side_m, tag.half_side_m, 0.5F * kBoard), tag.world_from_tag, nullptr});
    tags_.push_back(std::move(tag));
  }
}

void World::add_plants(const Spec& spec, const glm::vec3& eye) {
  const glm::vec2 from_sun = -glm::vec2(light_.sun_direction());
  cards_.resize(spec.plants.size());
  shadow_cards_.resize(spec.plants.size());
  const auto focal_px = static_cast<float>(spec.camera.intrinsics(0, 0));
  parallel_for(static_cast<int>(2 * spec.plants.size()), [&](int job) {
    const auto i = static_cast<std::size_t>(job / 2);
    const bool for_sun = job % 2 == 1;
    const PlantSpec& plant = spec.plants[i];
    const glm::vec3 foot(plant.position);
    const glm::vec2 view = for_sun ? from_sun : glm::vec2(foot - eye);
    const float per_m = for_sun ? 70.0F : glm::clamp(1.2F * focal_px / glm::length(view), 20.0F, 420.0F);
    const glm::vec2 ahead = glm::normalize(view);
    Card& card = for_sun ? shadow_cards_[i] : cards_[i];
    card.foot = foot;
    card.right = {ahead.y, -ahead.x};
    card.half_width_m = static_cast<float>(0.6 * plant.width_m);
    card.height_m = static_cast<float>(1.1 * plant.height_m);
    card.texels_per_m = per_m;
    card.painting = std::make_shared<const Painting>(
        paint_plant(plant, view, light_, per_m, spec.seed + 900U + static_cast<std::uint32_t>(i)));
  });
}

// Everything that can take the sun away, by where it lies seen from the sun.
void World::build_shadow_grid() {
  const glm::vec3 sun = light_.sun_direction();
  across_sun_ = glm::normalize(
      glm::cross(std::abs(sun.z) < 0.99F ? glm::vec3(0.0F, 0.0F, 1.0F) : glm::vec3(1.0F, 0.0F, 0.0F), sun));
  above_sun_ = glm::cross(sun, across_sun_);
  struct Rect {
    glm::vec2 low{1e9F}, high{-1e9F};
    Caster caster;
  };
  std::vector<Rect> rects;
  const auto add = [&](const std::vector<glm::vec3>& corners, std::size_t index, bool card) {
    Rect rect;
    rect.caster = {static_cast<std::uint16_t>(index), card, -1e9F};
    for (const glm::vec3& corner : corners) {
      const glm::vec2 at(glm::dot(corner, across_sun_), glm::dot(corner, above_sun_));
      rect.low = glm::min(rect.low, at - 0.15F);  // the disc's half shadow, 30 m behind
      rect.high = glm::max(rect.high, at + 0.15F);
      rect.caster.reach_m = std::max(rect.caster.reach_m, glm::dot(corner, sun));
    }
    rects.push_back(rect);
  };
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    std::vector<glm::vec3> corners;
    for (unsigned c = 0; c < 8; ++c) {
      const glm::vec3 sign((c & 1U) != 0 ? 1.0F : -1.0F, (c & 2U) != 0 ? 1.0F : -1.0F, (c & 4U) != 0 ? 1.0F : -1.0F);
      corners.push_back(blocks_[i].centre + blocks_[i].world_from_local * (sign * blocks_[i].half));
    }
    add(corners, i, false);
  }
  for (std::size_t i = 0; i < shadow_cards_.size(); ++i) {
    const Card& card = shadow_cards_[i];
    const glm::vec3 side = glm::vec3(card.right, 0.0F) * card.half_width_m;
    const glm::vec3 top(0.0F, 0.0F, card.height_m);
    add({card.foot - side, card.foot + side, card.foot - side + top, card.foot + side + top}, i, true);
  }
  grid_.assign(static_cast<std::size_t>(kGrid) * kGrid, {});
  if (rects.empty()) return;
  glm::vec2 high(-1e9F);
  grid_low_ = glm::vec2(1e9F);
  for (const Rect& rect : rects) {
    grid_low_ = glm::min(grid_low_, rect.low);
    high = glm::max(high, rect.high);
  }
  grid_cell_ = (high - grid_low_) / static_cast<float>(kGrid);
  for (const Rect& rect : rects) {
    const glm::ivec2 from = glm::clamp(glm::ivec2((rect.low - grid_low_) / grid_cell_), 0, kGrid - 1);
    const glm::ivec2 to = glm::clamp(glm::ivec2((rect.high - grid_low_) / grid_cell_), 0, kGrid - 1);
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x) grid_[static_cast<std::size_t>(y * kGrid + x)].push_back(rect.caster);
  }
}

// How much of the sky's light the things around leave to the ground: cosine-weighted rays upward.
void World::bake_openness(const glm::vec2& centre) {
  open_low_ = centre - 0.5F * kOpenMetres;
  open_.assign(static_cast<std::size_t>(kOpenSide) * kOpenSide, 1.0F);
  parallel_for(kOpenSide, [&](int y) {
    for (int x = 0; x < kOpenSide; ++x) {
      const glm::vec2 at = open_low_ + (glm::vec2(x, y) + 0.5F) * (kOpenMetres / kOpenSide);
      Random random(hash_cell(x, y, seed_ + 1000U));
      constexpr int kRays = 64;
      float open = 0.0F;
      for (int i = 0; i < kRays; ++i) {
        const float r2 = (static_cast<float>(i) + random.next()) / kRays;
        const float turn =
            2.0F * std::numbers::pi_v<float> * (static_cast<float>(i) * 0.618034F + random.next() / kRays);
        const glm::vec3 d(std::sqrt(r2) * std::cos(turn), std::sqrt(r2) * std::sin(turn), std::sqrt(1.0F - r2));
        float seen = 1.0F;
        for (const Block& block : blocks_) {
          float t = 40.0F;
          glm::vec3 normal;
          if (block.surface != nullptr && hit_block(block, glm::vec3(at, 0.002F), d, t, normal)) seen = 0.0F;
        }
        for (const Card& card : shadow_cards_) {  // a plant takes light as an upright ellipsoid of leaves does
          const glm::vec3 radii(0.42F * card.half_width_m, 0.42F * card.half_width_m, 0.5F * card.height_m);
          const glm::vec3 o = (glm::vec3(at, 0.0F) - card.foot - glm::vec3(0.0F, 0.0F, radii.z)) / radii;
          const glm::vec3 e = d / radii;
          const float b = glm::dot(o, e);
          const float root = b * b - glm::dot(e, e) * (glm::dot(o, o) - 1.0F);
          if (root > 0.0F && -b + std::sqrt(root) > 0.0F) seen *= 0.45F;
        }
        open += seen / kRays;
      }
      open_[static_cast<std::size_t>(y * kOpenSide + x)] = open;
    }
  });
}

float World::openness(const glm::vec2& ground) const {
  const glm::vec2 at = (ground - open_low_) * (kOpenSide / kOpenMetres) - 0.5F;
  if (at.x < 0.0F || at.y < 0.0F || at.x >= kOpenSide - 1.0F || at.y >= kOpenSide - 1.0F) return 1.0F;
  const int x = static_cast<int>(at.x);
  const int y = static_cast<int>(at.y);
  const glm::vec2 f = at - glm::vec2(x, y);
  const float* const row = &open_[static_cast<std::size_t>(y * kOpenSide + x)];
  return glm::mix(glm::mix(row[0], row[1], f.x), glm::mix(row[kOpenSide], row[kOpenSide + 1], f.x), f.y);
}

void World::candidates(const glm::vec3& apex, const glm::vec3& axis, float half_angle_rad, Candidates& found) const {
  found.boxes.clear();
  found.tags.clear();
  found.cards.clear();
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (in_cone(apex, axis, half_angle_rad, blocks_[i].centre, glm::length(blocks_[i].half)))
      found.boxes.push_back(static_cast<std::uint16_t>(i));
  }
  for (std::size_t i = 0; i < tags_.size(); ++i) {
    if (in_cone(apex, axis, half_angle_rad, tags_[i].centre, 1.4143F * tags_[i].half_side_m))
      found.tags.push_back(static_cast<std::uint16_t>(i));
  }
  for (std::size_t i = 0; i < cards_.size(); ++i) {
    const float half_height = 0.5F * cards_[i].height_m;
    const glm::vec3 middle = cards_[i].foot + glm::vec3(0.0F, 0.0F, half_height);
    if (in_cone(apex, axis, half_angle_rad, middle, std::hypot(cards_[i].half_width_m, half_height)))
      found.cards.push_back(static_cast<std::uint16_t>(i));
  }
}

}  // namespace app::synth
