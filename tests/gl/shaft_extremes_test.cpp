// What must hold for every technique there is, wherever the sun and however thick the medium.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/testing/light_rig.h"

namespace render::test {
namespace {

// Each technique as cheap as it is still itself.
// Every technique that is registered, with few steps and at full size, and the march's other spacings.
std::vector<ShaftSettings> every_technique() {
  std::vector<ShaftSettings> all{parse_shaft_settings("march:steps=48,spacing=depth"),
                                 parse_shaft_settings("march:steps=48,spacing=growing")};
  for (const ShaftTechniqueInfo& info : shaft_techniques()) {
    // What the others are held against.
    if (info.name == "closed-form" || info.name == "reference") continue;
    ShaftSettings& settings = all.emplace_back(ShaftSettings{.technique = info.name});
    for (const ShaftParameter& parameter : info.parameters) {
      if (parameter.name == "steps") settings.parameters["steps"] = 48.0;
      if (parameter.name == "divisor") settings.parameters["divisor"] = parameter.low;
    }
  }
  return all;
}

Medium haze(double extinction_per_m, double g) {
  return {.extinction_per_m = extinction_per_m, .albedo = 0.8, .g = g};
}

// A post and a beam before the eye, on the ground.
SceneState posts(double sun_azimuth_deg, double sun_elevation_deg) {
  SceneState scene = sunny(sun_azimuth_deg, sun_elevation_deg);
  scene.camera = look_at(64, 48, {0.0, 0.0, 1.5}, {0.0, 10.0, 1.5}, 50.0);
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true),
                     place(make_box({0.3F, 0.3F, 2.0F}), {0.5, 6.0, 1.0}, false),
                     place(make_box({4.0F, 0.3F, 0.3F}), {0.0, 7.0, 2.4}, false)};
  scene.medium = haze(0.05, 0.5);
  return scene;
}

void expect_within(const Pixels& found, const Pixels& unshadowed, const std::string& what) {
  for (std::size_t i = 0; i < found.rgba.size(); ++i) {
    const glm::vec4 p = found.rgba[i];
    ASSERT_TRUE(std::isfinite(p.r) && std::isfinite(p.g) && std::isfinite(p.b) && std::isfinite(p.a)) << what;
    ASSERT_GE(std::min({p.r, p.g, p.b}), 0.0F) << what;
    ASSERT_GE(p.a, 0.0F) << what;
    ASSERT_LE(p.a, 1.0F) << what;
    ASSERT_LE(p.r, unshadowed.rgba[i].r * 1.002F + 1e-6F) << what << " pixel " << i;  // half floats hold 11 bits
  }
}

double relative_rmse(const Pixels& found, const Pixels& truth) {
  double error = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
    error += std::pow(found.rgba[i].r - truth.rgba[i].r, 2.0);
    total += std::pow(truth.rgba[i].r, 2.0);
  }
  return std::sqrt(error / std::max(total, 1e-30));
}

const ShaftSettings kUnshadowed = parse_shaft_settings("closed-form:divisor=1");

TEST(ShaftExtremes, EveryTechniqueStaysBelowTheUnshadowedFormInAnyAir) {
  for (const double extinction : {0.0, 1e-9, 1.0, 1e3}) {
    for (const int kind : {0, 1, 2}) {
      SceneState scene = posts(10.0, 12.0);
      scene.medium = haze(extinction, kind % 2 == 0 ? 0.99 : -0.99);
      if ((kind & 1) != 0) scene.medium->extent = Box{{-5.0, -5.0, 0.0}, {5.0, 15.0, 4.0}};
      if ((kind & 2) != 0) scene.medium->falloff = HeightFalloff{.base_m = 0.5, .scale_height_m = 1.5};
      const Pixels unshadowed = rig().render(scene, kUnshadowed).shafts;
      for (const ShaftSettings& technique : every_technique()) {
        expect_within(
            rig().render(scene, technique).shafts, unshadowed,
            to_text(technique) + " extinction " + std::to_string(extinction) + " kind " + std::to_string(kind));
      }
    }
  }
}

TEST(ShaftExtremes, EveryTechniqueStaysBelowTheUnshadowedFormUnderAnySun) {
  // Seen in the middle, at the picture's edge, beside it, above, behind, in the eye's own plane, and at the horizon.
  for (const glm::dvec2 sun : {glm::dvec2(0.0, 1.0),
                               {31.4, 8.0},
                               {60.0, 20.0},
                               {0.0, 90.0},
                               {180.0, 1.0},
                               {175.0, 30.0},
                               {90.0, 0.0},
                               {90.0, 25.0},
                               {5.0, 0.0}}) {
    const SceneState scene = posts(sun.x, sun.y);
    const Pixels unshadowed = rig().render(scene, kUnshadowed).shafts;
    for (const ShaftSettings& technique : every_technique()) {
      expect_within(rig().render(scene, technique).shafts, unshadowed,
                    to_text(technique) + " sun at " + std::to_string(sun.x) + ", " + std::to_string(sun.y));
    }
  }
}

TEST(ShaftExtremes, MapsOfOneTexelAndOfManyDoNoHarm) {
  const SceneState scene = posts(20.0, 30.0);
  for (const int size : {1, 8192}) {
    const Pixels unshadowed = rig().render(scene, kUnshadowed, size).shafts;
    for (const ShaftSettings& technique : every_technique()) {
      expect_within(rig().render(scene, technique, size).shafts, unshadowed, to_text(technique) + std::to_string(size));
    }
  }
}

TEST(ShaftExtremes, SealedBoxStaysAtZero) {
  // The sun's place inside, beside and behind the picture, which is large enough for lines of unlike lengths side by
  // side.
  for (const double azimuth : {3.0, 30.0, 160.0, 250.0}) {
    SceneState scene = sunny(azimuth, 35.0, 0.0);
    scene.camera = look_at(202, 151, {0.0, 0.0, 1.5}, {0.0, 10.0, 1.5}, 70.0);
    scene.instances = {place(sealed_room(), {0.0, 0.0, 1.5}, false)};
    for (const double extinction : {0.01, 0.5, 50.0}) {
      scene.medium = haze(extinction, 0.5);
      for (const ShaftSettings& technique : every_technique()) {
        EXPECT_EQ(brightest(rig().render(scene, technique).shafts), 0.0F)
            << to_text(technique) << " azimuth " << azimuth << " extinction " << extinction;
      }
    }
  }
}

TEST(ShaftExtremes, StillCameraGivesBitEqualFrames) {
  const SceneState scene = posts(15.0, 20.0);
  SceneState other = posts(200.0, 50.0);
  for (const ShaftSettings& technique : every_technique()) {
    const Pixels first = rig().render(scene, technique).shafts;
    rig().render(other, technique);  // nothing of another frame is kept
    EXPECT_TRUE(first == rig().render(scene, technique).shafts) << to_text(technique);
  }
}

// The sun's place crosses the picture's edge, and passes from before the eye's plane to behind it. A small step of the
// sun changes any technique's picture about as little as that of the march, which knows nothing of such places.
TEST(ShaftExtremes, PictureIsContinuousWhereTheSunsPlaceCrossesAnEdgeAndInfinity) {
  const ShaftSettings march = parse_shaft_settings("march:steps=256");
  const double edge_deg = glm::degrees(std::atan(std::tan(glm::radians(25.0)) * 64.0 / 48.0));
  for (const double azimuth : {edge_deg, 90.0}) {
    const SceneState before = posts(azimuth - 0.005, 6.0);
    const SceneState after = posts(azimuth + 0.005, 6.0);
    const double expected = relative_rmse(rig().render(before, march).shafts, rig().render(after, march).shafts);
    for (const ShaftSettings& technique : every_technique()) {
      const double step = relative_rmse(rig().render(before, technique).shafts, rig().render(after, technique).shafts);
      EXPECT_LT(step, expected + 0.01) << to_text(technique) << " at azimuth " << azimuth;  // 1 %: hardly to be seen
    }
  }
}

TEST(ShaftExtremes, NothingDependsOnTheWorldsOriginUpToTenKilometresAway) {
  SceneState here = posts(25.0, 28.0);
  here.medium->falloff = HeightFalloff{.base_m = 0.0, .scale_height_m = 4.0};
  here.medium->extent = Box{{-5.0, -5.0, 0.0}, {5.0, 15.0, 4.0}};
  SceneState there = here;
  const glm::dvec3 away(8000.0, -6000.0, 500.0);
  there.camera.world_from_camera[3] += glm::dvec4(away, 0.0);
  for (Instance& instance : there.instances) instance.world_from_model[3] += glm::dvec4(away, 0.0);
  there.medium->falloff->base_m += away.z;
  there.medium->extent = Box{here.medium->extent->min_in_world + away, here.medium->extent->max_in_world + away};
  for (const ShaftSettings& technique : every_technique()) {
    const double moved = relative_rmse(rig().render(there, technique).shafts, rig().render(here, technique).shafts);
    EXPECT_LT(moved, 2e-3) << to_text(technique);  // single steps of a march fall to the other side of an edge
  }
}

}  // namespace
}  // namespace render::test
