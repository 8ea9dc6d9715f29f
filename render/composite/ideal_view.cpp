#include "render/composite/ideal_view.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace render {
namespace {

constexpr int kCellPx = 16;

bool is_finite(const glm::vec2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

struct Bounds {
  glm::dvec2 min{std::numeric_limits<double>::max()};
  glm::dvec2 max{std::numeric_limits<double>::lowest()};
  bool cut = false;
};

Bounds ideal_bounds(const LensMap& map) {
  const double widest = std::tan(kWidestOffAxisRad);
  Bounds bounds;
  for (const glm::vec2& ideal : map.ideal) {
    if (!is_finite(ideal)) continue;
    const glm::dvec2 kept = glm::clamp(glm::dvec2(ideal), -widest, widest);
    bounds.cut = bounds.cut || kept != glm::dvec2(ideal);
    bounds.min = glm::min(bounds.min, kept);
    bounds.max = glm::max(bounds.max, kept);
  }
  if (bounds.min.x > bounds.max.x) throw std::runtime_error("the lens map has no pixel that looks anywhere");
  return bounds;
}

// Pixels a unit of ideal coordinates, where the picture looks along its axis.
glm::dvec2 centre_resolution(const LensMap& map) {
  const auto at = [&](int x, int y) { return glm::dvec2(map.ideal[static_cast<std::size_t>(y * map.width + x)]); };
  double nearest = std::numeric_limits<double>::max();
  glm::dvec2 density(1.0);
  for (int y = 0; y + 1 < map.height; y += 2) {
    for (int x = 0; x + 1 < map.width; x += 2) {
      const glm::dvec2 here = at(x, y);
      const glm::dvec2 step(at(x + 1, y).x - here.x, at(x, y + 1).y - here.y);
      const double off_axis = glm::dot(here, here);
      if (!(off_axis < nearest) || !(step.x > 0.0) || !(step.y > 0.0)) continue;
      nearest = off_axis;
      density = 1.0 / step;
    }
  }
  return density;
}

View lens_view(const LensMap& map, double scale) {
  const Bounds bounds = ideal_bounds(map);
  if (bounds.cut) {
    spdlog::warn("the lens sees more than {:.0f} degrees off its axis; nothing virtual is drawn farther out",
                 kWidestOffAxisRad * 180.0 / 3.14159265358979);
  }
  const glm::dvec2 extent = bounds.max - bounds.min;
  glm::dvec2 focal = scale * centre_resolution(map);
  const glm::dvec2 wanted = extent * focal + 2.0;
  const double shrink = std::min(1.0, (kLargestIdealPx - 2.0) / std::max(wanted.x, wanted.y));
  if (shrink < 1.0) spdlog::info("virtual things are drawn at {:.2f} of the picture's centre resolution", shrink);
  focal *= shrink;
  View view;
  view.width = static_cast<int>(std::ceil(extent.x * focal.x)) + 2;
  view.height = static_cast<int>(std::ceil(extent.y * focal.y)) + 2;
  view.focal_px = focal;
  view.centre_px = 1.0 - bounds.min * focal;  // a pixel of margin for the bilinear lookup
  return view;
}

// Whole pixels; what that rounds, both axes' resolutions take up, so that it shows exactly what the large one shows.
View scaled_view(View view, double scale) {
  const glm::dvec2 size(view.width, view.height);
  view.width = std::max(2, static_cast<int>(std::lround(size.x * scale)));
  view.height = std::max(2, static_cast<int>(std::lround(size.y * scale)));
  const glm::dvec2 factor = glm::dvec2(view.width, view.height) / size;
  view.focal_px *= factor;
  view.centre_px *= factor;
  return view;
}

}  // namespace

View ideal_view(const Camera& camera, double scale) {
  if (!camera.lens) return scale < 1.0 ? scaled_view(pinhole_view(camera), scale) : pinhole_view(camera);
  if (camera.lens->width != camera.width || camera.lens->height != camera.height) {
    throw std::runtime_error(fmt::format("the lens map is {} x {} pixels, the picture {} x {}", camera.lens->width,
                                         camera.lens->height, camera.width, camera.height));
  }
  View view = lens_view(*camera.lens, scale);
  look_from(camera, view);
  return view;
}

void look_from(const Camera& camera, View& view) {
  view.eye_in_world = glm::dvec3(camera.world_from_camera[3]);
  view.world_from_camera = glm::dmat3(camera.world_from_camera);
}

LensLookup::LensLookup(const LensMap& map, const View& view)
    : width_(map.width),
      height_(map.height),
      columns_((map.width + kCellPx - 1) / kCellPx),
      texture_(GL_RG32F, map.width, map.height, gl::Filter::Nearest, 1, "lens map") {
  const int rows = (map.height + kCellPx - 1) / kCellPx;
  const float far = std::numeric_limits<float>::max();
  cells_.assign(static_cast<std::size_t>(columns_ * rows), Cell{glm::vec2(far), glm::vec2(-far)});
  std::vector<glm::vec2> uv(map.ideal.size(), glm::vec2(-1.0F));
  const glm::dvec2 size(view.width, view.height);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
      if (!is_finite(map.ideal[i])) continue;
      const glm::dvec2 px = glm::dvec2(map.ideal[i]) * view.focal_px + view.centre_px;
      if (px.x < 0.0 || px.y < 0.0 || px.x > size.x || px.y > size.y) continue;
      uv[i] = px / size;
      Cell& cell = cells_[static_cast<std::size_t>(y / kCellPx * columns_ + x / kCellPx)];
      cell.min_px = glm::min(cell.min_px, glm::vec2(px));
      cell.max_px = glm::max(cell.max_px, glm::vec2(px));
    }
  }
  texture_.upload(GL_RG, GL_FLOAT, uv.data());
}

PixelRect LensLookup::real_from_ideal(const PixelRect& ideal) const {
  const float slack = 1.0F;  // bilinear lookup reaches half a pixel out
  const glm::vec2 low(static_cast<float>(ideal.x) - slack, static_cast<float>(ideal.y) - slack);
  const glm::vec2 high(static_cast<float>(ideal.x + ideal.width) + slack,
                       static_cast<float>(ideal.y + ideal.height) + slack);
  glm::ivec2 first(width_, height_);
  glm::ivec2 last(0);
  for (std::size_t i = 0; i < cells_.size() && !ideal.empty(); ++i) {
    const Cell& cell = cells_[i];
    if (glm::any(glm::lessThan(cell.max_px, low)) || glm::any(glm::greaterThan(cell.min_px, high))) continue;
    const glm::ivec2 at(static_cast<int>(i) % columns_ * kCellPx, static_cast<int>(i) / columns_ * kCellPx);
    first = glm::min(first, at);
    last = glm::max(last, at + kCellPx);
  }
  last = glm::min(last, glm::ivec2(width_, height_));
  if (last.x <= first.x || last.y <= first.y) return {};
  return {first.x, first.y, last.x - first.x, last.y - first.y};
}

}  // namespace render
