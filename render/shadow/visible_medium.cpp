#include "render/shadow/visible_medium.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "render/gl/read_back.h"

namespace render {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kLargestStep = 1.0 / 32.0;  // of a fit's size

struct Segment {
  double from = 0.0;
  double to = kInfinite;

  // Keeps what lies between two planes: where origin + t * direction is within [low, high].
  void cut(double origin, double direction, double low, double high) {
    if (direction == 0.0) {
      if (origin < low || origin > high) to = -1.0;
      return;
    }
    const double a = (low - origin) / direction;
    const double b = (high - origin) / direction;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
};

// In a fit's coordinates, across the light.
struct Rectangle {
  glm::dvec2 low{kInfinite};
  glm::dvec2 high{-kInfinite};

  void add(const glm::dvec2& at, const glm::dvec2& margin) {
    low = glm::min(low, at - margin);
    high = glm::max(high, at + margin);
  }
};

// The distance of the farthest thing in the tiles around a corner of them.
double reach_at_corner(const VisibleDepth& seen, int column, int row) {
  double reach = 0.0;
  for (int y = std::max(row - 1, 0); y <= std::min(row, seen.rows - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column, seen.columns - 1); ++x) {
      reach = std::max(reach, seen.axis_distance_m[static_cast<std::size_t>(y * seen.columns + x)]);
    }
  }
  return reach;
}

}  // namespace

VisibleDepth VisibleDepthPass::read(const View& view, GLuint depth) {
  VisibleDepth seen;
  seen.columns = (view.width + VisibleDepth::kTilePx - 1) / VisibleDepth::kTilePx;
  seen.rows = (view.height + VisibleDepth::kTilePx - 1) / VisibleDepth::kTilePx;
  seen.axis_distance_m.assign(static_cast<std::size_t>(seen.columns) * static_cast<std::size_t>(seen.rows), kInfinite);
  if (depth == 0) return seen;
  if (farthest_.width() != seen.columns || farthest_.height() != seen.rows) {
    farthest_ = gl::Texture(GL_R32F, seen.columns, seen.rows, gl::Filter::Nearest, 1, "farthest in tiles");
    framebuffer_ = gl::Framebuffer({&farthest_}, nullptr, "farthest in tiles");
  }
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  framebuffer_.bind();
  program_.use();
  program_.bind("view_depth", {GL_TEXTURE_2D, depth});
  program_.set("tile_px", VisibleDepth::kTilePx);
  gl::draw_full_screen(no_vertices_);
  const std::vector<float> found = gl::read_red(farthest_.id(), seen.columns, seen.rows);
  std::ranges::transform(found, seen.axis_distance_m.begin(), [](float value) {
    return value < 1.0F ? View::kNearM / std::max(1.0 - static_cast<double>(value), 1e-12) : kInfinite;
  });
  return seen;
}

ShadowFit fit_to_visible_medium(const ShadowFit& whole, int size_px, const View& view, const Medium& medium,
                                const VisibleDepth& seen, const AxisRange& range) {
  if (whole.empty) return whole;
  const glm::dmat4 map_from_local = whole.map_from_world * glm::inverse(view.local_from_world());
  const glm::dvec3 eye(map_from_local[3]);
  const glm::dmat3 ray_from_px = view.local_ray_from_px();
  // Rays between a tile's corners are no farther to the side than this, for each metre along the axis.
  const double spread = 0.75 * VisibleDepth::kTilePx / std::min(view.focal_px.x, view.focal_px.y);
  const glm::dvec2 size_m(whole.metres_per_unit);
  Rectangle covered;
  for (int row = 0; row <= seen.rows; ++row) {
    for (int column = 0; column <= seen.columns; ++column) {
      const glm::dvec3 ray = ray_from_px * glm::dvec3(column * VisibleDepth::kTilePx, row * VisibleDepth::kTilePx, 1.0);
      const glm::dvec3 along = glm::dmat3(map_from_local) * ray;
      Segment segment{range.from_m, std::min(reach_at_corner(seen, column, row), range.to_m)};
      for (int axis = 0; axis < 2; ++axis) segment.cut(eye[axis], along[axis], 0.0, 1.0);
      segment.cut(eye.z, along.z, 0.0, kInfinite);
      for (int axis = 0; axis < 3 && medium.extent; ++axis) {
        segment.cut(0.0, ray[axis], medium.extent->min_in_world[axis] - view.eye_in_world[axis],
                    medium.extent->max_in_world[axis] - view.eye_in_world[axis]);
      }
      if (segment.to < segment.from) continue;
      // A ray along the light stays over one place.
      const double end = std::isfinite(segment.to) ? segment.to : segment.from;
      for (const double t : {segment.from, end}) covered.add(glm::dvec2(eye + t * along), t * spread / size_m);
    }
  }
  ShadowFit fit = whole;
  fit.cut = true;
  fit.empty = covered.low.x > covered.high.x;
  if (fit.empty) return fit;
  const glm::dvec2 margin(3.0 / size_px);
  const glm::dvec2 size = glm::clamp(covered.high - covered.low, 16.0 / size_px, 1.0);
  const glm::dvec2 step = glm::min(glm::exp2(glm::floor(glm::log2(size / 4.0))), kLargestStep);
  const glm::dvec2 low = glm::clamp(glm::floor((covered.low - margin) / step) * step, glm::dvec2(0.0), 1.0 - step);
  const glm::dvec2 high = glm::clamp(glm::ceil((covered.high + margin) / step) * step, step, glm::dvec2(1.0));
  const glm::dvec2 part = glm::max(high - low, step);
  fit.map_from_world = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / part, 1.0)) *
                       glm::translate(glm::dmat4(1.0), glm::dvec3(-low, 0.0)) * whole.map_from_world;
  fit.metres_per_unit *= glm::dvec3(part, 1.0);
  return fit;
}

}  // namespace render
