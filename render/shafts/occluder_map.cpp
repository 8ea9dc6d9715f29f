#include "render/shafts/occluder_map.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "render/shafts/shaft_target.h"

namespace render {
namespace {

struct Range {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  // A box's corners, taken to where this range is counted.
  void add(const glm::dmat4& here_from_box, const glm::dvec3& box_low, const glm::dvec3& box_high) {
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 corner = glm::mix(box_low, box_high, glm::bvec3((i & 1) != 0, (i & 2) != 0, (i & 4) != 0));
      const glm::dvec3 at(here_from_box * glm::dvec4(corner, 1.0));
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
  }
};

}  // namespace

void OccluderMap::update(const ShaftInputs& inputs, const SunShadow& maps) {
  Key key;
  key.maps = &maps;
  for (std::size_t i = 0; i < kOccluderKinds.size(); ++i) key.revisions[i] = maps.map(kOccluderKinds[i]).revision;
  if (const auto& extent = inputs.scene.medium->extent) {
    key.box_low = extent->min_in_world;
    key.box_high = extent->max_in_world;
  }
  if (made_ && key == key_) return;
  key_ = key;
  made_ = true;
  empty_ = std::ranges::all_of(kOccluderKinds, [&](Occluders kind) { return maps.map(kind).fit.empty; });
  if (empty_) return;
  only_.reset();
  if (coarseness_ == 1) {
    for (std::size_t i = 0; i < kOccluderKinds.size(); ++i) {
      if (maps.map(kOccluderKinds[1 - i]).fit.empty) only_ = kOccluderKinds[i];
    }
  }
  if (only_) {
    const ShadowMap& map = maps.map(*only_);
    map_from_world_ = map.fit.map_from_world;
    size_m_ = map.fit.metres_per_unit;
    size_px_ = glm::ivec2(map.size_px);
    return;
  }
  place(inputs);
  draw(inputs);
}

void OccluderMap::place(const ShaftInputs& inputs) {
  // Counted in metres along the axes that both shadow maps share.
  glm::dmat4 axes(1.0);
  Range all;
  for (const Occluders kind : kOccluderKinds) {
    const ShadowFit& fit = key_.maps->map(kind).fit;
    if (fit.empty) continue;
    if (all.low.x > all.high.x) axes = glm::scale(glm::dmat4(1.0), fit.metres_per_unit) * fit.map_from_world;
    all.add(axes * glm::inverse(fit.map_from_world), glm::dvec3(0.0), glm::dvec3(1.0));
  }
  if (const auto& extent = inputs.scene.medium->extent) {
    Range medium;
    medium.add(axes, extent->min_in_world, extent->max_in_world);
    for (int axis = 0; axis < 2; ++axis) {
      const double low = std::max(all.low[axis], medium.low[axis]);
      const double high = std::min(all.high[axis], medium.high[axis]);
      if (low >= high) continue;  // beside the medium: nothing is marched, whatever the map
      all.low[axis] = low;
      all.high[axis] = high;
    }
  }
  size_m_ = all.high - all.low;
  map_from_world_ = glm::scale(glm::dmat4(1.0), 1.0 / size_m_) * glm::translate(glm::dmat4(1.0), -all.low) * axes;
}

glm::ivec2 OccluderMap::wanted_size() const {
  int largest = 1;
  glm::dvec2 texel_m(std::numeric_limits<double>::infinity());
  for (const Occluders kind : kOccluderKinds) {
    const ShadowMap& map = key_.maps->map(kind);
    if (map.fit.empty) continue;
    largest = std::max(largest, map.size_px);
    texel_m = glm::min(texel_m, glm::dvec2(map.fit.metres_per_unit) / static_cast<double>(map.size_px));
  }
  if (coarseness_ != 1) return glm::ivec2((largest + coarseness_ - 1) / coarseness_);
  const glm::dvec2 needed = glm::ceil(glm::dvec2(size_m_) / texel_m - 1e-6);
  return glm::ivec2(glm::clamp(needed, 1.0, std::min(2.0 * largest, 8192.0)));
}

void OccluderMap::draw(const ShaftInputs& inputs) {
  int present = 0;
  gl::Defines defines;
  for (std::size_t i = 0; i < kOccluderKinds.size(); ++i) {
    if (key_.maps->map(kOccluderKinds[i]).fit.empty) continue;
    present |= 1 << i;
    defines.push_back({i == 0 ? "VIRTUAL_OCCLUDERS" : "REAL_OCCLUDERS"});
  }
  size_px_ = wanted_size();
  if (depth_.width() != size_px_.x || depth_.height() != size_px_.y) {
    depth_ = gl::LayeredTexture(gl::LayeredTexture::Kind::Array, GL_R32F, size_px_.x, size_px_.y, 1,
                                gl::Filter::Nearest, "first occluders");
    framebuffer_ = gl::Framebuffer(depth_, 0, "first occluders");
  }
  const gl::Program& program =
      programs_.try_emplace(present, "lib/full_screen.vert", "shafts/occluder_map.frag", defines).first->second;
  plain_state();
  framebuffer_.bind();
  program.use();
  program.set("texel", 1.0F / glm::vec2(size_px_));
  key_.maps->bind_depth(program, "shadow_depth");
  std::array<glm::vec3, kOccluderKinds.size()> scales{};
  std::array<glm::vec3, kOccluderKinds.size()> lows{};
  glm::ivec2 layers(0);
  for (std::size_t i = 0; i < kOccluderKinds.size(); ++i) {
    const ShadowMap& map = key_.maps->map(kOccluderKinds[i]);
    if (map.fit.empty) continue;
    const glm::dmat4 shadow_from_map = map.fit.map_from_world * glm::inverse(map_from_world_);
    scales[i] = glm::vec3(shadow_from_map[0].x, shadow_from_map[1].y, shadow_from_map[2].z);
    lows[i] = glm::vec3(shadow_from_map[3]);
    layers[static_cast<int>(i)] = map.layer;
  }
  program.set("scales", scales.data(), static_cast<int>(scales.size()));
  program.set("lows", lows.data(), static_cast<int>(lows.size()));
  program.set("layers", layers);
  gl::draw_full_screen(no_vertices_);
}

void OccluderMap::bind_depth(const gl::Program& program) const {
  if (only_) {
    key_.maps->bind_depth(program, "occluder_depth");
  } else {
    program.bind("occluder_depth", depth_.handle());
  }
  program.set("occluder_layer", only_ ? key_.maps->map(*only_).layer : 0);
}

void OccluderMap::bind(const gl::Program& program, const ShaftInputs& inputs) const {
  const glm::dvec2 texel_m = glm::dvec2(size_m_) / glm::dvec2(size_px_);
  program.set("map_from_local", glm::mat4(map_from_world_ * glm::inverse(inputs.view.local_from_world())));
  program.set("end_margin_m", static_cast<float>(3.0 * std::max(texel_m.x, texel_m.y)));
  program.set("end_margin", 0.0F);
  bind_depth(program);
}

}  // namespace render
