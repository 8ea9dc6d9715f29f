#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/testing/light_rig.h"

namespace render::test {
namespace {

const ShaftSettings kMarch{.technique = "interleaved", .parameters = {{"steps", 64}, {"divisor", 1}}};
constexpr float kHalf = 2e-3F;  // half floats hold 11 bits; the closed forms are compared to four times that

Medium haze(double extinction_per_m, double g) {
  Medium medium;
  medium.extinction_per_m = extinction_per_m;
  medium.albedo = 0.8;
  medium.g = g;
  return medium;
}

SceneState level_view() {
  SceneState scene = sunny(200.0, 40.0, 0.0);
  scene.camera = look_at(64, 48, {0.0, 0.0, 1.5}, {0.0, 10.0, 1.5}, 40.0);
  scene.medium = haze(0.1, 0.5);
  return scene;
}

// The direction of the view ray through the middle of a pixel.
glm::dvec3 direction(const SceneState& scene, int x, int y) {
  const View view = pinhole_view(scene.camera);
  return glm::normalize(view.local_ray_from_px() * glm::dvec3(x + 0.5, y + 0.5, 1.0));
}

double sun_source(const SceneState& scene, const glm::dvec3& ray) {
  const Medium& m = *scene.medium;
  return sun_of(scene).illuminance_rgb.r * scene.exposure * m.albedo *
         phase(m.phase_function, m.g, glm::dot(ray, sun_of(scene).direction_in_world));
}

TEST(Shafts, WithoutOccludersTheyAreTheClosedFormUpToTheGround) {
  for (const char* technique : {"closed-form", "march", "interleaved"}) {
    for (const PhaseFunction function :
         {PhaseFunction::HenyeyGreenstein, PhaseFunction::CornetteShanks, PhaseFunction::Rayleigh}) {
      SceneState scene = level_view();
      scene.medium->phase_function = function;
      scene.instances = {place(make_ground(), glm::dvec3(0.0), true)};
      const LightPictures pictures = rig().render(scene, {.technique = technique, .parameters = {{"divisor", 1}}});
      for (const int y : {30, 36, 47}) {
        const glm::dvec3 ray = direction(scene, 20, y);
        const double distance = 1.5 / -ray.z;
        const double expected = sun_source(scene, ray) * scattered_fraction(0.1, distance);
        EXPECT_NEAR(pictures.shafts.at(20, y).r, expected, kHalf * expected) << technique << " row " << y;
        EXPECT_NEAR(pictures.shafts.at(20, y).a, std::exp(-0.1 * distance), 1e-3) << technique << " row " << y;
      }
    }
  }
}

TEST(Shafts, GainsScaleTheSunsAndTheSkysPartEachByItself) {
  SceneState scene = level_view();
  const float sun = rig().render(scene, kMarch).shafts.at(32, 5).r;
  scene.sky_light.radiance_sh[0] = glm::dvec3(9000.0);
  const float both = rig().render(scene, kMarch).shafts.at(32, 5).r;
  scene.medium->shaft_gain = 0.0;
  EXPECT_NEAR(rig().render(scene, kMarch).shafts.at(32, 5).r, both - sun, kHalf * both);
  scene.medium->shaft_gain = 3.0;
  scene.medium->fog_gain = 0.5;
  const LightPictures pictures = rig().render(scene, kMarch);
  EXPECT_NEAR(pictures.shafts.at(32, 5).r, 3.0F * sun + 0.5F * (both - sun), 3.0F * kHalf * both);
  EXPECT_EQ(pictures.shafts.at(32, 5).a, 0.0F);  // the medium lets through what it did
}

TEST(Shafts, UnboundedHazeBeforeTheSkyIsOpaque) {
  const SceneState scene = level_view();
  const LightPictures pictures = rig().render(scene, kMarch);
  const double expected = sun_source(scene, direction(scene, 32, 5));
  EXPECT_NEAR(pictures.shafts.at(32, 5).r, expected, kHalf * expected);
  EXPECT_EQ(pictures.shafts.at(32, 5).a, 0.0F);
}

TEST(Shafts, BoundedMediumAttenuatesTheSunOnItsOwnWay) {
  SceneState scene = level_view();
  scene.medium->extinction_per_m = 0.3;
  scene.medium->extent = Box{{-2.0, 4.0, 0.0}, {3.0, 7.0, 4.0}};
  const LightPictures pictures = rig().render(scene, kMarch);
  const glm::dvec3 ray = direction(scene, 32, 20);
  const glm::dvec3 sun = sun_of(scene).direction_in_world;
  // Brute force in double.
  double sum = 0.0;
  const double enter = 4.0 / ray.y;
  const double leave = 7.0 / ray.y;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double t = enter + (leave - enter) * (i + 0.5) / kSteps;
    const glm::dvec3 p = glm::dvec3(0.0, 0.0, 1.5) + t * ray;
    const double path = std::min(
        {((sun.x > 0 ? 3.0 : -2.0) - p.x) / sun.x, ((sun.y > 0 ? 7.0 : 4.0) - p.y) / sun.y, (4.0 - p.z) / sun.z});
    sum += 0.3 * std::exp(-0.3 * (t - enter + path)) * (leave - enter) / kSteps;
  }
  const double expected = sun_source(scene, ray) * sum;
  EXPECT_NEAR(pictures.shafts.at(32, 20).r, expected, kHalf * expected);
  EXPECT_NEAR(pictures.shafts.at(32, 20).a, std::exp(-0.3 * (leave - enter)), 1e-3);
}

// Half the world lies under a large slab: along a level ray the boundary of its shadow is where geometry says.
TEST(Shafts, LargeSlabCutsTheLightWhereGeometrySays) {
  SceneState scene = level_view();
  ensure_sun(scene).direction_in_world = sun_direction(0.0, 45.0);  // from the north, ahead
  // A slab 3 m above the eye, its southern edge at y = 8: the shadow's edge meets the eye's height at y = 5.
  scene.instances = {place(make_box({1000.0, 1000.0, 0.01}), {0.0, 508.0, 4.5}, false)};
  const LightPictures pictures =
      rig().render(scene, {.technique = "interleaved", .parameters = {{"steps", 128}, {"divisor", 1}}});
  const glm::dvec3 ray = direction(scene, 32, 24);
  const double lit = (8.0 - 3.0) / ray.y;
  const double expected = sun_source(scene, ray) * scattered_fraction(0.1, lit);
  // The slab is cut to some 100 m, of which a step of the march is about 1 m before the average over 16 offsets.
  EXPECT_NEAR(pictures.shafts.at(32, 24).r, expected, 0.03 * expected);
}

TEST(Shafts, ExtremesStayFiniteAndNeverExceedTheUnshadowedForm) {
  for (const double extinction : {0.0, 1e-9, 1e-3, 1.0, 1e3}) {
    for (const double g : {-0.99, 0.0, 0.99}) {
      for (const bool bounded : {false, true}) {
        SceneState scene = level_view();
        ensure_sun(scene).direction_in_world = sun_direction(0.0, 0.5);  // almost into the sun
        scene.medium = haze(extinction, g);
        if (bounded) scene.medium->extent = Box{{-5.0, -5.0, 0.0}, {5.0, 15.0, 4.0}};
        scene.instances = {place(make_ground(), glm::dvec3(0.0), true),
                           place(make_box({0.3, 0.3, 2.0}), {0.5, 6.0, 1.0}, false)};
        const LightPictures marched = rig().render(scene, kMarch);
        const LightPictures closed = rig().render(scene, {.technique = "closed-form", .parameters = {{"divisor", 1}}});
        for (std::size_t i = 0; i < marched.shafts.rgba.size(); ++i) {
          const glm::vec4 m = marched.shafts.rgba[i];
          ASSERT_TRUE(std::isfinite(m.r) && std::isfinite(m.a)) << extinction << " " << g;
          ASSERT_GE(m.r, 0.0F);
          ASSERT_LE(m.r, closed.shafts.rgba[i].r * 1.001F + 1e-7F) << extinction << " " << g << " " << bounded;
        }
        if (extinction == 0.0) {
          EXPECT_EQ(marched.shafts.at(3, 3), glm::vec4(0.0F, 0.0F, 0.0F, 1.0F));
        }
      }
    }
  }
}

TEST(Shafts, SealedBoxLetsNoSunIn) {
  for (const double azimuth : {30.0, 160.0, 250.0}) {
    SceneState scene = level_view();
    ensure_sun(scene).direction_in_world = sun_direction(azimuth, 35.0);
    scene.instances = {place(sealed_room(), {0.0, 0.0, 1.5}, false)};
    scene.medium->extinction_per_m = 0.5;
    const LightPictures pictures = rig().render(scene, kMarch);
    EXPECT_EQ(brightest(pictures.shafts), 0.0F) << "azimuth " << azimuth;
    EXPECT_LT(brightest(pictures.added), 1e-3F) << "azimuth " << azimuth;
  }
}

// Seen across the sun's azimuth, the upper edge of the dark shaft behind a board falls at the sun's elevation.
TEST(Shafts, DarkShaftRunsAlongTheSun) {
  for (const double elevation : {20.0, 40.0, 60.0}) {
    SceneState scene = sunny(90.0, elevation, 0.0);
    scene.camera = look_at(400, 400, {0.0, -30.0, 2.0}, {0.0, 0.0, 2.0}, 8.0);
    scene.instances = {place(make_box({0.01, 8.0, 1.0}), {1.0, 0.0, 3.0}, false)};
    scene.medium = haze(0.02, 0.7);
    scene.medium->extent = Box{{-4.0, -4.0, 0.0}, {4.0, 4.0, 5.0}};
    const LightPictures pictures =
        rig().render(scene, {.technique = "interleaved", .parameters = {{"steps", 64}, {"divisor", 1}}});
    dump(pictures, "shaft_" + std::to_string(static_cast<int>(elevation)), 0.0F);
    // The boundary that runs down from the board's upper edge, half way between light and dark, in many columns.
    std::vector<glm::dvec2> boundary;
    for (int x = 100; x < 240; ++x) {
      for (int y = 24; y < 380; ++y) {
        const float above = pictures.shafts.at(x, y - 1).r;
        const float below = pictures.shafts.at(x, y).r;
        const float half = 0.5F * pictures.shafts.at(x, 20).r;
        if (above < half || below >= half) continue;
        boundary.emplace_back(x, y - 1.0 + static_cast<double>((above - half) / (above - below)));
        break;
      }
    }
    ASSERT_GT(boundary.size(), 60U) << "elevation " << elevation;
    glm::dvec2 mean(0.0);
    for (const glm::dvec2& p : boundary) mean += p / static_cast<double>(boundary.size());
    double xx = 0.0;
    double xy = 0.0;
    for (const glm::dvec2& p : boundary) {
      xx += (p.x - mean.x) * (p.x - mean.x);
      xy += (p.x - mean.x) * (p.y - mean.y);
    }
    EXPECT_NEAR(glm::degrees(std::atan(-xy / xx)), elevation, 0.5);
  }
}

TEST(Shafts, StillCameraGivesBitEqualFrames) {
  SceneState scene = sunny(250.0, 30.0);
  scene.camera = look_at(320, 180, {0.0, -6.0, 1.6}, {0.0, 0.0, 1.2}, 55.0);
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true), load("pergola", glm::dvec3(0.0))};
  scene.medium = haze(0.03, 0.7);
  const LightPictures first = rig().render(scene);
  const LightPictures second = rig().render(scene);
  EXPECT_TRUE(first.shafts == second.shafts);
}

TEST(Shafts, SixtyFourInterleavedStepsComeCloseToAThousand) {
  SceneState scene = sunny(20.0, 35.0);
  scene.camera = look_at(640, 360, {0.3, -6.0, 1.6}, {0.0, 0.0, 1.3}, 55.0);
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true), load("pergola", glm::dvec3(0.0))};
  scene.medium = haze(0.06, 0.7);
  const LightPictures fine =
      rig().render(scene, {.technique = "interleaved", .parameters = {{"steps", 1024}, {"divisor", 1}}});
  const LightPictures coarse =
      rig().render(scene, {.technique = "interleaved", .parameters = {{"steps", 64}, {"divisor", 1}}});
  dump(coarse, "pergola_shafts");
  double error = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < fine.shafts.rgba.size(); ++i) {
    const double d = coarse.shafts.rgba[i].r - fine.shafts.rgba[i].r;
    error += d * d;
    total += static_cast<double>(fine.shafts.rgba[i].r) * fine.shafts.rgba[i].r;
  }
  EXPECT_LT(std::sqrt(error / total), 0.01);
}

}  // namespace
}  // namespace render::test
