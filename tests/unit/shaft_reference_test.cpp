#include "render/shafts/reference/shaft_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/testing/hazy_scene.h"

namespace render {
namespace {

TEST(ShaftReference, WithoutOccludersIsTheClosedForm) {
  const SceneState scene = hazy(0.03);
  const ReferenceLight light = ShaftReference(scene).along(kEastward, 40.0);
  expect_same(light.luminance_rgb, sun_scale(scene, kEastward) * (1.0 - std::exp(-1.2)), 1e-12);
  EXPECT_NEAR(light.transmittance, std::exp(-1.2), 1e-14);
  EXPECT_EQ(light.error_rgb, glm::dvec3(0.0));
  const ReferenceLight endless = ShaftReference(scene).along(kEastward, kEndless);
  expect_same(endless.luminance_rgb, sun_scale(scene, kEastward), 1e-12);
  EXPECT_EQ(endless.transmittance, 0.0);
}

TEST(ShaftReference, HalfSpaceInShadow) {
  // A plate at z = 5 from x = -90 to 10: its edge's shadow meets the ray at x = 10 - (5 - 1) = 6.
  SceneState scene = hazy(0.05);
  Mesh plate;
  add_plate(plate, {-90.0F, -50.0F}, {10.0F, 50.0F}, 5.0F);
  scene.instances.push_back(place(model_of(plate)));
  const ReferenceLight light = ShaftReference(scene).along(kEastward, 40.0);
  expect_same(light.luminance_rgb, sun_scale(scene, kEastward) * (std::exp(-0.3) - std::exp(-2.0)));
  EXPECT_EQ(ShaftReference(scene).along(kEastward, 6.0).luminance_rgb, glm::dvec3(0.0));
}

TEST(ShaftReference, SlitInShadow) {
  // A slit 1 mm wide at x = 10 lights one millimetre at x = 6, a kilometre of plate around it.
  SceneState scene = hazy(0.05);
  Mesh plates;
  add_plate(plates, {-500.0F, -50.0F}, {10.0F, 50.0F}, 5.0F);
  add_plate(plates, {10.0009765625F, -50.0F}, {500.0F, 50.0F}, 5.0F);
  scene.instances.push_back(place(model_of(plates)));
  const ReferenceLight light = ShaftReference(scene).along(kEastward, 40.0);
  const double width = 0.0009765625;
  expect_same(light.luminance_rgb, sun_scale(scene, kEastward) * (-std::exp(-0.3) * std::expm1(-0.05 * width)));
}

TEST(ShaftReference, LookingAtTheSunPastAnEdge) {
  SceneState scene = hazy(0.05);
  Mesh plate;
  add_plate(plate, {-10.0F, -50.0F}, {10.0F, 50.0F}, 5.0F);
  scene.instances.push_back(place(model_of(plate)));
  const ReferenceLight up = ShaftReference(scene).along({{0.0, 0.0, 1.0}, sun_of(scene).direction_in_world}, 30.0);
  const double hit = 4.0 * std::numbers::sqrt2;  // in the plate's shadow up to the plate, then free
  const glm::dvec3 scale = kLux * 0.9 * phase(PhaseFunction::HenyeyGreenstein, 0.4, 1.0);
  expect_same(up.luminance_rgb, scale * (std::exp(-0.05 * hit) - std::exp(-1.5)));
  const ReferenceLight down = ShaftReference(scene).along({{0.0, 0.0, 9.0}, -sun_of(scene).direction_in_world}, 8.0);
  const glm::dvec3 back = kLux * 0.9 * phase(PhaseFunction::HenyeyGreenstein, 0.4, -1.0);
  expect_same(down.luminance_rgb, back * (1.0 - std::exp(-0.05 * 4.0 * std::numbers::sqrt2)));
}

// Composite Simpson rule with many panels: slow, and nothing of the reference's own.
double simpson(const std::function<double(double)>& function, double from, double to, int panels = 20000) {
  double sum = function(from) + function(to);
  for (int i = 1; i < panels; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * function(from + (to - from) * i / panels);
  return sum * (to - from) / (3.0 * panels);
}

TEST(ShaftReference, SunIsAttenuatedInsideABoundedMedium) {
  for (const bool falloff : {false, true}) {
    SceneState scene = hazy(0.2);
    scene.medium->extent = Box{{-4.0, -3.0, 0.0}, {5.0, 3.0, 4.0}};
    if (falloff) scene.medium->falloff = HeightFalloff{.base_m = 1.0, .scale_height_m = 2.0};
    const ViewRay ray{{-6.0, -1.0, 0.5}, glm::normalize(glm::dvec3(1.0, 0.1, 0.2))};
    // Whole panels on both sides of the place where the light's way changes from side to top: x = 5 - (4 - z).
    const double entry = 2.0 / ray.direction_in_world.x;
    const double change = (5.0 + 6.0 - 4.0 + 0.5) / (ray.direction_in_world.x - ray.direction_in_world.z);
    const double end = 11.0 / ray.direction_in_world.x;
    const auto value = [&](double t) {
      const glm::dvec3 x = ray.origin_in_world + t * ray.direction_in_world;
      const double depth = optical_depth(*scene.medium, ray.origin_in_world + entry * ray.direction_in_world,
                                         ray.direction_in_world, std::max(0.0, t - entry));
      return extinction_at(*scene.medium, x) *
             std::exp(-depth - sun_optical_depth(*scene.medium, x, sun_of(scene).direction_in_world));
    };
    const double expected = simpson(value, entry, change) + simpson(value, change, end);
    const ReferenceLight light = ShaftReference(scene).along(ray, kEndless);
    expect_same(light.luminance_rgb, sun_scale(scene, ray) * expected, 1e-8);
  }
}

TEST(ShaftReference, DensityThatIsAFalloffIsTheFalloff) {
  SceneState scene = hazy(0.1);
  scene.medium->extent = Box{{-4.0, -3.0, 0.0}, {5.0, 3.0, 4.0}};
  ReferenceSettings settings;
  settings.density = [](const glm::dvec3& x) { return std::exp(-x.z / 1.5); };
  const ViewRay ray{{-6.0, -1.0, 0.5}, glm::normalize(glm::dvec3(1.0, 0.1, 0.2))};
  const ReferenceLight varying = ShaftReference(scene, settings).along(ray, kEndless);
  scene.medium->falloff = HeightFalloff{.base_m = 0.0, .scale_height_m = 1.5};
  const ReferenceLight closed = ShaftReference(scene).along(ray, kEndless);
  expect_same(varying.luminance_rgb, closed.luminance_rgb, 1e-9);
  EXPECT_NEAR(varying.transmittance, closed.transmittance, 1e-10);
}

TEST(ShaftReference, PointLightInAUniformMedium) {
  // The airlight integral [Sun, Ramamoorthi, Narasimhan & Nayar 2005, eq. 9] with h the light's distance from the ray:
  // sigma_s I / (4 pi h) exp(-s nearest) * integral of exp(-s h (sin x + 1) / cos x) over the angle x at the light.
  SceneState scene = hazy(0.05);
  ensure_sun(scene).illuminance_rgb = glm::dvec3(0.0);
  scene.medium->g = 0.0;
  ReferenceSettings settings;
  settings.lights = {{.position_in_world = {8.0, 3.0, 1.0}, .luminous_intensity_rgb = kLux}};
  const double s = 0.05;
  const double h = 3.0;
  const auto value = [&](double x) { return std::exp(-s * h * (std::sin(x) + 1.0) / std::cos(x)); };
  const glm::dvec3 scale = kLux * (0.9 * s / (4.0 * kPi * h) * std::exp(-s * 8.0));
  const double from = std::atan(-8.0 / h);
  const ReferenceLight open = ShaftReference(scene, settings).along(kEastward, 20.0);
  expect_same(open.luminance_rgb, scale * simpson(value, from, std::atan(12.0 / h)));
  // A wall at y = 1.5 from x = 9 on shades the ray from x = 10 on.
  Mesh wall;
  add_plate(wall, {9.0F, -50.0F}, {500.0F, 50.0F}, 1.5F);
  Instance upright = place(model_of(wall));
  upright.world_from_model =
      glm::dmat4(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 0, 1));
  scene.instances.push_back(upright);
  const ReferenceLight shaded = ShaftReference(scene, settings).along(kEastward, 20.0);
  expect_same(shaded.luminance_rgb, scale * simpson(value, from, std::atan(2.0 / h)));
}

TEST(ShaftReference, MaskedOccluderIsPiercedWhereItsTextureIsClear) {
  // Texels across the plate: clear, solid, solid, clear; between their centres alpha is linear and passes the cutoff
  // half way. The plate's shadow on the ray runs from x = 0 to 8, so solid is 2 ... 6.
  SceneState scene = hazy(0.05);
  Mesh plate;
  add_plate(plate, {4.0F, -50.0F}, {12.0F, 50.0F}, 5.0F);
  Material leaf;
  leaf.alpha_mode = AlphaMode::Mask;
  leaf.base_color_texture = {.image = 0, .wrap = TextureWrap::Clamp};
  Model model = model_of(plate, leaf);
  model.images.push_back({.width = 4, .height = 1, .rgba = {}});
  for (const std::uint8_t alpha : std::array<std::uint8_t, 4>{0, 255, 255, 0}) {
    for (int i = 0; i < 3; ++i) model.images[0].rgba.push_back(128);
    model.images[0].rgba.push_back(alpha);
  }
  scene.instances.push_back(place(std::move(model)));
  const ReferenceLight light = ShaftReference(scene).along(kEastward, 20.0);
  const double lit = (1.0 - std::exp(-0.05 * 2.0)) + (std::exp(-0.05 * 6.0) - std::exp(-0.05 * 20.0));
  expect_same(light.luminance_rgb, sun_scale(scene, kEastward) * lit);
}

TEST(ShaftReference, BlendedOccluderTints) {
  SceneState scene = hazy(0.05);
  Mesh plate;
  add_plate(plate, {4.0F, -50.0F}, {12.0F, 50.0F}, 5.0F);
  Material glass;
  glass.alpha_mode = AlphaMode::Blend;
  glass.base_color = {1.0F, 0.25F, 0.0F, 0.5F};
  scene.instances.push_back(place(model_of(plate, glass)));
  const ReferenceLight light = ShaftReference(scene).along(kEastward, 8.0);
  EXPECT_GT(light.luminance_rgb.r, light.luminance_rgb.g);
  EXPECT_GT(light.luminance_rgb.g, light.luminance_rgb.b);
  EXPECT_GT(light.luminance_rgb.b, 0.0);
  EXPECT_LT(light.luminance_rgb.r, (sun_scale(scene, kEastward) * (1.0 - std::exp(-0.4))).r);
}

Mesh random_triangles(std::mt19937& random, int count) {
  std::uniform_real_distribution<float> at(-10.0F, 10.0F);
  std::uniform_real_distribution<float> off(-1.5F, 1.5F);
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 middle(at(random), at(random), at(random));
    for (int k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
      mesh.vertices.push_back({middle + glm::vec3(off(random), off(random), off(random)), {}, {}, {}});
    }
  }
  return mesh;
}

// Whether any triangle lies between a point and the light, by Moeller & Trumbore's test of every one.
bool in_shadow(const Mesh& mesh, const glm::dvec3& x, const glm::dvec3& towards, double distance) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::dvec3 a(mesh.vertices[i].position);
    const glm::dvec3 e1 = glm::dvec3(mesh.vertices[i + 1].position) - a;
    const glm::dvec3 e2 = glm::dvec3(mesh.vertices[i + 2].position) - a;
    const glm::dvec3 p = glm::cross(towards, e2);
    const double det = glm::dot(e1, p);
    const double u = glm::dot(x - a, p) / det;
    const glm::dvec3 q = glm::cross(x - a, e1);
    const double v = glm::dot(towards, q) / det;
    const double t = glm::dot(e2, q) / det;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < distance) return true;
  }
  return false;
}

TEST(ShadowSheet, AgreesWithSingleRaysAmongRandomTriangles) {
  std::mt19937 random(7);
  const Mesh mesh = random_triangles(random, 250);
  const std::vector<Instance> instances{place(model_of(mesh))};
  const OccluderTree occluders(instances);
  EXPECT_EQ(occluders.size(), 250U);
  const ShadowSheet sheet(occluders);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int dark = 0;
  for (int i = 0; i < 60; ++i) {
    const ViewRay ray{glm::dvec3(any(random), any(random), any(random)) * 12.0,
                      glm::normalize(glm::dvec3(any(random), any(random), any(random)))};
    const bool parallel = i % 2 == 0;
    const glm::dvec3 target(any(random), any(random), any(random));
    const LightOrigin light{parallel ? glm::normalize(target) : target * 12.0, parallel};
    const std::vector<LitSegment> lit = sheet.lit(ray, light, 0.0, 25.0);
    for (int k = 0; k < 200; ++k) {
      const double t = 25.0 * (k + 0.5) / 200.0;
      const glm::dvec3 x = ray.origin_in_world + t * ray.direction_in_world;
      const glm::dvec3 towards = parallel ? light.in_world : glm::normalize(light.in_world - x);
      const double distance = parallel ? kEndless : glm::length(light.in_world - x);
      const bool found = std::ranges::none_of(lit, [t](const LitSegment& s) { return s.from_m <= t && t <= s.to_m; });
      EXPECT_EQ(found, in_shadow(mesh, x, towards, distance)) << "ray " << i << " at " << t;
      dark += found ? 1 : 0;
    }
  }
  EXPECT_GT(dark, 1000);
  EXPECT_LT(dark, 11000);
}

TEST(ShaftReference, SealedBoxStaysDark) {
  SceneState scene = hazy(0.2);
  scene.sky_light.radiance_sh[0] = glm::dvec3(1000.0);
  scene.instances.push_back(place(make_box({4.0F, 3.0F, 2.5F}), {10.0, 20.0, 1.25}));
  const ShaftReference reference(scene, {.max_error = 0.1});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 40; ++i) {
    const ViewRay ray{{10.3, 19.8, 1.1}, glm::normalize(glm::dvec3(any(random), any(random), any(random)))};
    const double end = ShadowSheet(OccluderTree(scene.instances)).first_hit_m(ray, 0.0, kEndless);
    EXPECT_LT(end, 3.0);
    EXPECT_EQ(reference.along(ray, end).luminance_rgb, glm::dvec3(0.0)) << i;
  }
}

TEST(ShaftReference, DoesNotDependOnTheWorldsOrigin) {
  SceneState scene = hazy(0.05);
  std::mt19937 random(5);
  const Mesh mesh = random_triangles(random, 100);
  scene.instances.push_back(place(model_of(mesh)));
  const ReferenceLight here = ShaftReference(scene).along(kEastward, 20.0);
  const glm::dvec3 away(8000.0, -6000.0, 300.0);
  scene.instances[0].world_from_model = place_model(away, 0.0, 1.0);
  const ReferenceLight there = ShaftReference(scene).along({kEastward.origin_in_world + away, {1.0, 0.0, 0.0}}, 20.0);
  expect_same(there.luminance_rgb, here.luminance_rgb, 1e-9);
}

TEST(ShaftReference, DiscOfTheSunSoftensEdgesWithinTheReportedError) {
  // Half-space in shadow: each direction of the disc has its own edge on the ray. By quadrature over the disc's chord:
  // the edge lies where the direction's slope z / x says; a strip of the disc at angle a has weight 2 sqrt(r^2 - a^2).
  SceneState scene = hazy(0.3);
  scene.medium->g = 0.0;
  ensure_sun(scene).angular_radius_rad = 0.05;
  Mesh plate;
  add_plate(plate, {-90.0F, -90.0F}, {10.0F, 90.0F}, 5.0F);
  scene.instances.push_back(place(model_of(plate)));
  const double r = sun_of(scene).angular_radius_rad;
  const auto strip = [&](double u) {  // a = r sin u, so that the weight is smooth
    const double edge = 10.0 - 4.0 / std::tan(kPi / 4.0 + r * std::sin(u));
    return 2.0 * std::cos(u) * std::cos(u) / kPi * (std::exp(-0.3 * edge) - std::exp(-0.3 * 8.0));
  };
  const glm::dvec3 expected = sun_scale(scene, kEastward) * simpson(strip, -kPi / 2.0, kPi / 2.0, 2000);
  const ReferenceLight light = ShaftReference(scene, {.max_error = 1e-3}).along(kEastward, 8.0);
  expect_same(light.luminance_rgb, expected, 3e-3);
  EXPECT_LT(light.error_rgb.r, 1e-2 * expected.r);
  EXPECT_GT(light.error_rgb.r, 0.0);
}

TEST(ShaftReference, TracedSkyIsTheOpenSkyLessWhatIsHidden) {
  SceneState scene = hazy(0.05);
  ensure_sun(scene).illuminance_rgb = glm::dvec3(0.0);
  scene.medium->g = 0.0;
  scene.sky_light.radiance_sh[0] = glm::dvec3(1000.0 * std::sqrt(4.0 * kPi));  // 1000 cd/m2 from everywhere
  const double all = 1000.0 * 0.9 * (1.0 - std::exp(-1.0));
  const ReferenceLight open = ShaftReference(scene, {.sky = ReferenceSky::Open}).along(kEastward, 20.0);
  expect_same(open.luminance_rgb, glm::dvec3(all));
  const ReferenceLight traced = ShaftReference(scene, {.max_error = 0.01}).along(kEastward, 20.0);
  expect_same(traced.luminance_rgb, glm::dvec3(all), 1e-6);  // patches tile the sphere exactly
  Mesh ceiling;
  add_plate(ceiling, {-1e5F, -1e5F}, {1e5F, 1e5F}, 3.0F);
  scene.instances.push_back(place(model_of(ceiling)));
  const ReferenceLight half = ShaftReference(scene, {.max_error = 0.01}).along(kEastward, 20.0);
  expect_same(half.luminance_rgb, glm::dvec3(0.5 * all), 1e-3);
}

}  // namespace
}  // namespace render
