#include "render/shafts/reference/shadow_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "render/shafts/reference/endless.h"
#include "render/shafts/reference/occluder_light.h"

namespace render {
namespace {

// Light so nearly along the ray that the two span no plane; then the ray alone decides.
constexpr double kAlong = 1e-9;
// Shadows so close together, in metres and as a part of the distance, are one: triangles that share an edge.
constexpr double kGap = 1e-8;

struct Interval {
  double from = 0.0;
  double to = 0.0;
};

struct Tint {
  Interval where;
  glm::dvec3 rgb;
};

// Coordinates in the plane of a view ray and a light: x along the ray, y off it on the light's side. Points are counted
// from the tree's origin.
class Plane {
 public:
  Plane(const OccluderTree& occluders, const ViewRay& ray, const LightOrigin& light)
      : eye_(ray.origin_in_world - occluders.origin_in_world()), x_axis_(ray.direction_in_world) {
    const glm::dvec3 to_light = light.parallel ? light.in_world : light.in_world - ray.origin_in_world;
    parallel_ = light.parallel;
    light_.x = glm::dot(to_light, x_axis_);
    const glm::dvec3 off = to_light - light_.x * x_axis_;
    light_.y = glm::length(off);
    if (spans()) {
      y_axis_ = off / light_.y;
    } else {  // any will do
      const glm::dvec3 other = std::abs(x_axis_.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
      y_axis_ = glm::normalize(glm::cross(x_axis_, other));
    }
    normal_ = glm::cross(x_axis_, y_axis_);
  }

  bool spans() const { return light_.y > kAlong; }
  const glm::dvec2& light() const { return light_; }
  glm::dvec3 from_eye(const glm::dvec3& point) const { return point - eye_; }
  double off_plane(const glm::dvec3& point) const { return glm::dot(normal_, point - eye_); }
  glm::dvec2 in_plane(const glm::dvec3& point) const {
    const glm::dvec3 p = point - eye_;
    return {glm::dot(x_axis_, p), glm::dot(y_axis_, p)};
  }

  // Highest y at which something can cast.
  double ceiling() const { return parallel_ ? kEndless : light_.y * (1.0 - 1e-12); }

  // Where the shadow of a point, 0 <= y <= ceiling, falls on the ray.
  double shadow(const glm::dvec2& p) const {
    if (parallel_) return p.x - p.y * (light_.x / light_.y);
    return light_.x + (p.x - light_.x) * (light_.y / (light_.y - p.y));
  }

  // What casts on [from, to] of the ray.
  SheetBounds bounds(double from, double to) const {
    return {.plane = half_space(normal_, 0.0),
            .lowest = half_space(y_axis_, 0.0),
            .left = edge(from),
            .right = to < kEndless ? edge(to) : HalfSpace{.normal = glm::dvec3(0.0), .offset = -1.0}};
  }

  // The ray itself from x = `from` on.
  SheetBounds along_ray(double from) const {
    return {.plane = half_space(normal_, 0.0),
            .lowest = half_space(y_axis_, 0.0),
            .left = half_space(x_axis_, -from),
            .right = half_space(y_axis_, 0.0)};
  }

 private:
  HalfSpace half_space(const glm::dvec3& normal, double offset) const {
    return {.normal = normal, .offset = offset - glm::dot(normal, eye_)};
  }

  // >= 0 where the shadow falls at `at` or beyond.
  HalfSpace edge(double at) const {
    const glm::dvec3 across =
        parallel_ ? light_.y * x_axis_ - light_.x * y_axis_ : light_.y * x_axis_ - (light_.x - at) * y_axis_;
    const double size = glm::length(across);
    return half_space(across / size, -at * light_.y / size);
  }

  glm::dvec3 eye_;
  glm::dvec3 x_axis_;
  glm::dvec3 y_axis_{0.0};
  glm::dvec3 normal_{0.0};
  glm::dvec2 light_{0.0};
  bool parallel_ = true;
};

// A line across a triangle, with its texture coordinates.
struct Cut {
  glm::dvec2 a, b;
  glm::dvec2 uv_a, uv_b;

  Cut part(double from, double to) const {
    return {glm::mix(a, b, from), glm::mix(a, b, to), glm::mix(uv_a, uv_b, from), glm::mix(uv_a, uv_b, to)};
  }
};

// Where the plane cuts a triangle. Each edge is cut from its end behind the plane, so that neighbours that share it get
// the very same point.
std::optional<Cut> cut(const Plane& plane, const OccluderTriangle& triangle) {
  const std::array<double, 3> off{plane.off_plane(triangle.corner[0]), plane.off_plane(triangle.corner[1]),
                                  plane.off_plane(triangle.corner[2])};
  std::array<glm::dvec2, 2> point;
  std::array<glm::dvec2, 2> uv;
  std::size_t found = 0;
  for (std::size_t i = 0; i < 3 && found < 2; ++i) {
    const std::size_t j = (i + 1) % 3;
    if ((off[i] < 0.0) == (off[j] < 0.0)) continue;
    const std::size_t behind = off[i] < 0.0 ? i : j;
    const std::size_t front = off[i] < 0.0 ? j : i;
    const double part = off[behind] / (off[behind] - off[front]);
    point[found] = plane.in_plane(glm::mix(triangle.corner[behind], triangle.corner[front], part));
    uv[found] = glm::mix(glm::dvec2(triangle.uv[behind]), glm::dvec2(triangle.uv[front]), part);
    ++found;
  }
  if (found < 2) return std::nullopt;
  return Cut{point[0], point[1], uv[0], uv[1]};
}

// The part of a cut that lies between the ray and the light.
std::optional<Cut> casting_part(const Cut& whole, double ceiling) {
  double from = 0.0;
  double to = 1.0;
  const double rise = whole.b.y - whole.a.y;
  const auto keep_above = [&](double value, double slope) {  // value + slope s >= 0
    if (slope > 0.0) from = std::max(from, -value / slope);
    if (slope < 0.0) to = std::min(to, -value / slope);
    if (slope == 0.0 && value < 0.0) to = -1.0;
  };
  keep_above(whole.a.y, rise);
  if (ceiling < kEndless) keep_above(ceiling - whole.a.y, -rise);
  if (from >= to) return std::nullopt;
  Cut part = whole.part(from, to);
  part.a.y = std::clamp(part.a.y, 0.0, ceiling);
  part.b.y = std::clamp(part.b.y, 0.0, ceiling);
  return part;
}

class Shadows {
 public:
  explicit Shadows(const Interval& range) : range_(range) {}

  void add(const Plane& plane, const OccluderTriangle& triangle) {
    const std::optional<Cut> whole = cut(plane, triangle);
    if (!whole) return;
    const std::optional<Cut> casts = casting_part(*whole, plane.ceiling());
    if (!casts) return;
    if (triangle.material == nullptr) {
      add_dark(plane.shadow(casts->a), plane.shadow(casts->b));
      return;
    }
    let_through(triangle, casts->uv_a, casts->uv_b, pieces_);
    for (const LetThrough& piece : pieces_) {
      const Cut part = casts->part(piece.from, piece.to);
      add_piece(plane.shadow(part.a), plane.shadow(part.b), piece.rgb);
    }
  }

  void add_dark(double a, double b) {
    const Interval shadow{std::max(std::min(a, b), range_.from), std::min(std::max(a, b), range_.to)};
    if (shadow.from < shadow.to) dark_.push_back(shadow);
  }

  std::vector<LitSegment> lit() {
    std::ranges::sort(dark_, {}, &Interval::from);
    std::vector<LitSegment> out;
    double reached = range_.from;
    for (const Interval& shadow : dark_) {
      if (shadow.from - reached > kGap * std::max(1.0, reached)) append(reached, shadow.from, out);
      reached = std::max(reached, shadow.to);
    }
    if (range_.to - reached > kGap * std::max(1.0, reached)) append(reached, range_.to, out);
    return out;
  }

 private:
  void add_piece(double a, double b, const glm::dvec3& rgb) {
    if (rgb == glm::dvec3(0.0)) return add_dark(a, b);
    if (rgb == glm::dvec3(1.0)) return;
    const Interval where{std::max(std::min(a, b), range_.from), std::min(std::max(a, b), range_.to)};
    if (where.from < where.to) tints_.push_back({where, rgb});
  }

  // [from, to] of the ray, split where tints begin and end.
  void append(double from, double to, std::vector<LitSegment>& out) const {
    std::vector<double> places{from, to};
    std::vector<const Tint*> here;
    for (const Tint& tint : tints_) {
      if (tint.where.to <= from || tint.where.from >= to) continue;
      here.push_back(&tint);
      places.push_back(std::max(tint.where.from, from));
      places.push_back(std::min(tint.where.to, to));
    }
    std::ranges::sort(places);
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      LitSegment segment{.from_m = places[i], .to_m = places[i + 1]};
      if (segment.from_m >= segment.to_m) continue;
      for (const Tint* tint : here) {
        const bool covers = tint->where.from <= segment.from_m && tint->where.to >= segment.to_m;
        if (covers) segment.through_rgb *= tint->rgb;
      }
      out.push_back(segment);
    }
  }

  Interval range_;
  std::vector<Interval> dark_;
  std::vector<Tint> tints_;
  std::vector<LetThrough> pieces_;
};

// Distance along a ray to a triangle it meets [Moeller & Trumbore 1997], with what the triangle lets through there.
std::optional<double> hit_m(const OccluderTriangle& triangle, const glm::dvec3& a_from_eye,
                            const glm::dvec3& direction) {
  const glm::dvec3 edge1 = triangle.corner[1] - triangle.corner[0];
  const glm::dvec3 edge2 = triangle.corner[2] - triangle.corner[0];
  const glm::dvec3 across = glm::cross(direction, edge2);
  const double determinant = glm::dot(edge1, across);
  if (determinant == 0.0) return std::nullopt;
  const glm::dvec3 from_corner = -a_from_eye;
  const double u = glm::dot(from_corner, across) / determinant;
  const glm::dvec3 q = glm::cross(from_corner, edge1);
  const double v = glm::dot(direction, q) / determinant;
  constexpr double kEdge = 1e-12;  // no gap between neighbours
  if (u < -kEdge || v < -kEdge || u + v > 1.0 + kEdge) return std::nullopt;
  if (triangle.material != nullptr) {
    std::vector<LetThrough> pieces;
    const glm::dvec2 uv =
        (1.0 - u - v) * glm::dvec2(triangle.uv[0]) + u * glm::dvec2(triangle.uv[1]) + v * glm::dvec2(triangle.uv[2]);
    let_through(triangle, uv, uv, pieces);
    if (pieces.front().rgb == glm::dvec3(1.0)) return std::nullopt;
  }
  return glm::dot(edge2, q) / determinant;
}

}  // namespace

std::vector<LitSegment> ShadowSheet::lit(const ViewRay& ray, const LightOrigin& light, double from_m,
                                         double to_m) const {
  if (from_m >= to_m) return {};
  const Plane plane(occluders_, ray, light);
  Shadows shadows({from_m, to_m});
  if (plane.spans()) {
    occluders_.walk(plane.bounds(from_m, to_m),
                    [&](const OccluderTriangle& triangle) { shadows.add(plane, triangle); });
    return shadows.lit();
  }
  // Everything on the line between a point and the light shadows it.
  const double light_x = !light.parallel ? plane.light().x : plane.light().x > 0.0 ? kEndless : -kEndless;
  occluders_.walk(plane.along_ray(light_x > 0.0 ? from_m : -kEndless), [&](const OccluderTriangle& triangle) {
    const std::optional<double> hit = hit_m(triangle, plane.from_eye(triangle.corner[0]), ray.direction_in_world);
    if (!hit) return;
    if (*hit < light_x) {
      shadows.add_dark(-kEndless, *hit);
    } else {
      shadows.add_dark(*hit, kEndless);
    }
  });
  return shadows.lit();
}

double ShadowSheet::first_hit_m(const ViewRay& ray, double from_m, double to_m) const {
  const Plane plane(occluders_, ray, {});
  double first = kEndless;
  occluders_.walk(plane.along_ray(from_m), [&](const OccluderTriangle& triangle) {
    const std::optional<double> hit = hit_m(triangle, plane.from_eye(triangle.corner[0]), ray.direction_in_world);
    if (hit && *hit >= from_m && *hit <= to_m) first = std::min(first, *hit);
  });
  return first;
}

}  // namespace render
