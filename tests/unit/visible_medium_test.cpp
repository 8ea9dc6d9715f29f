// The part of a shadow map that visible medium takes up.
#include "render/shadow/visible_medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>

#include "render/shadow/cascades.h"

namespace render {
namespace {

constexpr int kMapPx = 1024;

// A map of 20 x 16 x 18 m round a place, seen along the light.
ShadowFit whole_map(const glm::dvec3& sun, const glm::dvec3& middle_in_world) {
  const glm::dvec3 size(20.0, 16.0, 18.0);
  const glm::dmat4 light_from_world(glm::transpose(world_from_light(sun)));
  const glm::dvec3 low = glm::dvec3(light_from_world * glm::dvec4(middle_in_world, 1.0)) - 0.5 * size;
  ShadowFit fit;
  fit.map_from_world =
      glm::scale(glm::dmat4(1.0), 1.0 / size) * glm::translate(glm::dmat4(1.0), -low) * light_from_world;
  fit.metres_per_unit = size;
  fit.empty = false;
  return fit;
}

View view_at(const glm::dvec3& eye, double heading, double pitch) {
  const glm::dvec3 forward(std::sin(heading) * std::cos(pitch), std::cos(heading) * std::cos(pitch), std::sin(pitch));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
  View view;
  view.width = 320;
  view.height = 200;
  view.eye_in_world = eye;
  view.world_from_camera = glm::dmat3(right, glm::cross(forward, right), forward);
  view.focal_px = {240.0, 240.0};
  view.centre_px = {160.0, 100.0};
  return view;
}

VisibleDepth as_far_as(double distance_m, const View& view) {
  VisibleDepth seen;
  seen.columns = (view.width + VisibleDepth::kTilePx - 1) / VisibleDepth::kTilePx;
  seen.rows = (view.height + VisibleDepth::kTilePx - 1) / VisibleDepth::kTilePx;
  seen.axis_distance_m.assign(static_cast<std::size_t>(seen.columns * seen.rows), distance_m);
  return seen;
}

VisibleDepth depth_of(const View& view, std::mt19937& random) {
  VisibleDepth seen = as_far_as(0.0, view);
  std::uniform_real_distribution<double> distance(0.5, 40.0);
  for (double& far_m : seen.axis_distance_m) {
    const double d = distance(random);
    far_m = d > 35.0 ? std::numeric_limits<double>::infinity() : d;
  }
  return seen;
}

// Every place of visible medium that is behind the whole map is behind the part.
TEST(VisibleMedium, PartHoldsAllOfIt) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int inside = 0;
  for (int run = 0; run < 200; ++run) {
    const glm::dvec3 sun = glm::normalize(glm::dvec3(unit(random), unit(random), 0.05 + std::abs(unit(random))));
    const glm::dvec3 origin = run % 4 == 0 ? glm::dvec3(9000.0, -7000.0, 30.0) : glm::dvec3(0.0);
    const ShadowFit whole = whole_map(sun, origin);
    const glm::dvec3 eye = origin + 12.0 * glm::dvec3(unit(random), unit(random), unit(random));
    const View view = view_at(eye, 3.2 * unit(random), 1.3 * unit(random));
    Medium medium{.extinction_per_m = 0.02};
    if (run % 3 == 0) medium.extent = Box{origin - glm::dvec3(6, 7, 3), origin + glm::dvec3(8, 5, 4)};
    const VisibleDepth seen = depth_of(view, random);
    const ShadowFit part = fit_to_visible_medium(whole, kMapPx, view, medium, seen);
    for (int i = 0; i < 2000; ++i) {
      const glm::dvec2 px(0.5 * view.width * (1.0 + unit(random)), 0.5 * view.height * (1.0 + unit(random)));
      const int tile = static_cast<int>(px.y) / VisibleDepth::kTilePx * seen.columns +
                       static_cast<int>(px.x) / VisibleDepth::kTilePx;
      const double reach = std::min(seen.axis_distance_m[static_cast<std::size_t>(tile)], 200.0);
      const glm::dvec3 at = eye + 0.5 * (1.0 + unit(random)) * reach * (view.local_ray_from_px() * glm::dvec3(px, 1.0));
      const glm::dvec3 in_whole(whole.map_from_world * glm::dvec4(at, 1.0));
      if (in_whole.z < 0.0 || glm::any(glm::lessThan(glm::dvec2(in_whole), glm::dvec2(0.0))) ||
          glm::any(glm::greaterThan(glm::dvec2(in_whole), glm::dvec2(1.0)))) {
        continue;
      }
      if (medium.extent && (glm::any(glm::lessThan(at, medium.extent->min_in_world)) ||
                            glm::any(glm::greaterThan(at, medium.extent->max_in_world)))) {
        continue;
      }
      ++inside;
      ASSERT_FALSE(part.empty) << "run " << run;
      const glm::dvec3 in_part(part.map_from_world * glm::dvec4(at, 1.0));
      for (int axis = 0; axis < 2; ++axis) {
        ASSERT_GE(in_part[axis], 0.0) << "run " << run;
        ASSERT_LE(in_part[axis], 1.0) << "run " << run;
      }
      ASSERT_NEAR(in_part.z, in_whole.z, 1e-9);
    }
  }
  EXPECT_GT(inside, 20000);
}

TEST(VisibleMedium, PartIsSmallWhereTheViewEndsEarly) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.3, 1.0, 0.5));
  const ShadowFit whole = whole_map(sun, glm::dvec3(0.0));
  const View view = view_at({0.0, -2.0, 0.0}, 0.0, 0.0);
  const VisibleDepth seen = as_far_as(3.0, view);
  const ShadowFit part = fit_to_visible_medium(whole, kMapPx, view, {.extinction_per_m = 0.02}, seen);
  ASSERT_FALSE(part.empty);
  // A pyramid of 4 x 2.5 x 3 m, and a step of 1/32 to each side.
  EXPECT_LT(part.metres_per_unit.x, 0.5 * whole.metres_per_unit.x);
  EXPECT_LT(part.metres_per_unit.y, 0.5 * whole.metres_per_unit.y);
  EXPECT_EQ(part.metres_per_unit.z, whole.metres_per_unit.z);
}

TEST(VisibleMedium, NoneBehindTheOccludersNeedsNoMap) {
  const glm::dvec3 sun(0.0, 0.0, 1.0);
  const ShadowFit whole = whole_map(sun, glm::dvec3(0.0));
  const View above = view_at({0.0, 0.0, 30.0}, 0.0, 0.4);  // looks away, above all of them
  const VisibleDepth seen = as_far_as(50.0, above);
  EXPECT_TRUE(fit_to_visible_medium(whole, kMapPx, above, {.extinction_per_m = 0.02}, seen).empty);
  EXPECT_TRUE(fit_to_visible_medium(ShadowFit{}, kMapPx, above, {.extinction_per_m = 0.02}, seen).empty);
}

// A moving eye keeps its map for some frames.
TEST(VisibleMedium, PartStaysWhileTheViewMovesALittle) {
  const ShadowFit whole = whole_map(glm::normalize(glm::dvec3(0.3, 1.0, 0.5)), glm::dvec3(0.0));
  const VisibleDepth seen = as_far_as(3.0, view_at({0.0, -2.0, 0.0}, 0.0, 0.0));
  int changes = 0;
  ShadowFit last;
  for (int i = 0; i < 100; ++i) {
    const View view = view_at({0.01 * i, -2.0, 0.0}, 0.0, 0.0);
    const ShadowFit part = fit_to_visible_medium(whole, kMapPx, view, {.extinction_per_m = 0.02}, seen);
    changes += part != last ? 1 : 0;
    last = part;
  }
  EXPECT_LE(changes, 12);  // a metre is 1.6 to 2 steps, each of four sides at its own time; and the first
}

// Looks along a map of that many metres, 1.6 m above its middle.
std::vector<AxisRange> parts_of(double size_m, const Medium& medium, double eye_y_m = 0.0, int map_px = kMapPx,
                                double focal_px = 240.0) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(1.0, 0.2, 0.7));
  ShadowFit whole = whole_map(sun, glm::dvec3(0.0, 0.5 * size_m, 0.0));
  const glm::dvec3 size(size_m, size_m, size_m);
  const glm::dmat4 light_from_world(glm::transpose(world_from_light(sun)));
  whole.map_from_world =
      glm::scale(glm::dmat4(1.0), 1.0 / size) *
      glm::translate(glm::dmat4(1.0),
                     0.5 * size - glm::dvec3(light_from_world * glm::dvec4(0.0, 0.5 * size_m, 0.0, 1.0))) *
      light_from_world;
  whole.metres_per_unit = size;
  View view = view_at({0.0, eye_y_m, 1.6}, 0.0, 0.05);
  const double finer = focal_px / view.focal_px.x;
  view.width = static_cast<int>(finer * view.width);
  view.height = static_cast<int>(finer * view.height);
  view.focal_px *= finer;
  view.centre_px *= finer;
  const VisibleDepth seen = as_far_as(size_m, view);
  return split_cascades(whole, fit_to_visible_medium(whole, map_px, view, medium, seen), map_px, view, medium, seen);
}

TEST(Cascades, FollowOneAnotherFromTheEyeOn) {
  for (const double size_m : {5.0, 50.0, 500.0, 5000.0}) {
    for (const double extinction : {0.0, 1e-4, 0.01, 1.0, 100.0}) {
      const std::vector<AxisRange> parts = parts_of(size_m, {.extinction_per_m = extinction});
      ASSERT_GE(parts.size(), 1U);
      EXPECT_LE(parts.size(), 4U);
      EXPECT_EQ(parts.front().from_m, 0.0);
      EXPECT_TRUE(std::isinf(parts.back().to_m));
      for (std::size_t i = 1; i < parts.size(); ++i) {
        EXPECT_GT(parts[i].from_m, parts[i - 1].from_m);
        EXPECT_EQ(parts[i].from_m, parts[i - 1].to_m);
      }
    }
  }
}

TEST(Cascades, AreMoreThanOneOnlyWhereTexelsNearTheEyeAreCoarse) {
  EXPECT_EQ(parts_of(10.0, {.extinction_per_m = 0.02}).size(), 1U);    // a centimetre
  EXPECT_GT(parts_of(1000.0, {.extinction_per_m = 0.02}).size(), 1U);  // a metre
  // In clear medium the little that is near scatters next to nothing of what is seen; in thick medium it is all there
  // is.
  EXPECT_LT(parts_of(100.0, {.extinction_per_m = 1e-4}).size(), parts_of(100.0, {.extinction_per_m = 0.5}).size());
}

// A yard of 17 m, as the standard scenes are: a second map would take half as long again and hardly be seen.
TEST(Cascades, AreOneInAYard) {
  EXPECT_EQ(parts_of(17.0, {.extinction_per_m = 0.025}, 0.0, 2048, 1206.0).size(), 1U);
  EXPECT_GT(parts_of(17.0, {.extinction_per_m = 0.025}, 0.0, 256, 1206.0).size(), 1U);
}

TEST(Cascades, StayWhileTheViewMovesALittle) {
  int changes = 0;
  std::vector<AxisRange> last;
  for (int i = 0; i < 100; ++i) {
    std::vector<AxisRange> parts = parts_of(500.0, {.extinction_per_m = 0.02}, 0.01 * i);
    changes += parts != last ? 1 : 0;
    last = std::move(parts);
  }
  EXPECT_LE(changes, 3);  // the first, and a step now and then
}

}  // namespace
}  // namespace render
