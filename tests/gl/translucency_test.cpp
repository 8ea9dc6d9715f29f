#include <gtest/gtest.h>

#include <cmath>

#include "tests/testing/light_rig.h"
#include "tests/testing/truth.h"

namespace render::test {
namespace {

// A pane of that colour, and an opaque board beside it, hang level over the ground.
SceneState under_a_pane(const glm::vec4& color) {
  SceneState scene = sunny(200.0, 60.0, 0.0);
  Model pane = make_box({2.0, 2.0, 0.01});
  for (Material& material : pane.materials) {
    material.base_color = color;
    material.alpha_mode = AlphaMode::Blend;
  }
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true), place(std::move(pane), {0.0, 0.0, 2.5}, false),
                     place(make_box({1.0, 2.0, 0.1}), {1.6, 0.0, 2.5}, false)};
  scene.camera = look_at(96, 64, {0.0, -7.0, 1.8}, {0.3, 0.0, 1.3}, 45.0);
  scene.medium.emplace();
  scene.medium->extinction_per_m = 0.08;
  scene.medium->albedo = 0.9;
  scene.medium->g = 0.3;
  scene.medium->extent = Box{{-3, -3, 0}, {3, 3, 3}};
  return scene;
}

// A box has two faces for the light to come through.
glm::dvec3 let_through(const glm::dvec4& color) {
  const glm::dvec3 once = (1.0 - color.a) * glm::mix(glm::dvec3(1.0), glm::dvec3(color), color.a);
  return once * once;
}

constexpr glm::vec4 kRed{0.9F, 0.2F, 0.1F, 0.5F};

TEST(Translucent, EveryTechniqueTintsShaftsAsTheReferenceDoes) {
  const SceneState scene = under_a_pane(kRed);
  const ReferencePicture truth = truth_of(scene, ReferenceSky::None);
  for (const char* technique :
       {"march:steps=512", "interleaved:steps=128,divisor=1", "bilateral:steps=512,divisor=2,radius=2",
        "epipolar:steps=512,line_px=1,tolerance=0.01", "minmax:line_px=1,sample_px=8,tolerance=0.01"}) {
    const LightPictures found = rig().render(scene, parse_shaft_settings(technique));
    ASSERT_EQ(found.shafts.rgba.size(), truth.rgba.size()) << technique;
    glm::dvec3 squares(0.0);
    glm::dvec3 total(0.0);
    for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
      const glm::dvec3 expected = glm::dvec3(glm::vec3(truth.rgba[i])) * scene.exposure;
      const glm::dvec3 off = glm::dvec3(glm::vec3(found.shafts.rgba[i])) - expected;
      squares += off * off;
      total += expected * expected;
    }
    // Relative RMSE of each colour; interleaved and bilateral blur edges.
    const glm::dvec3 error = glm::sqrt(squares / total);
    EXPECT_LT(std::max({error.r, error.g, error.b}), 0.025) << technique << " " << error.r << " " << error.g;
  }
}

TEST(Translucent, TintsTheGroundBehindItAndNothingBesideIt) {
  SceneState scene = under_a_pane(kRed);
  scene.medium.reset();
  const double reach_m = 2.5 / std::tan(glm::radians(60.0));
  const glm::dvec3 shadow = -reach_m * glm::dvec3(std::sin(glm::radians(200.0)), std::cos(glm::radians(200.0)), 0.0);
  scene.camera = look_at(65, 65, shadow + glm::dvec3(0.0, 0.0, 2.0), shadow, 20.0, {0.0, 1.0, 0.0});
  const glm::dvec3 behind(glm::vec3(rig().render(scene).multiplier.at(32, 32)));
  const glm::dvec3 expected = let_through(kRed);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(behind[c], expected[c], 0.01) << "colour " << c;  // 8 bits, twice
  const glm::dvec3 aside = shadow - glm::dvec3(1.6, 0.0, 0.0);
  scene.camera = look_at(65, 65, aside + glm::dvec3(0.0, 0.0, 2.0), aside, 20.0, {0.0, 1.0, 0.0});
  EXPECT_EQ(glm::vec3(rig().render(scene).multiplier.at(32, 32)), glm::vec3(1.0F));
}

TEST(Translucent, ClearGlassChangesNothingAndOpaqueGlassIsABoard) {
  const ShaftSettings march = parse_shaft_settings("march:steps=256");
  SceneState scene = under_a_pane({1.0F, 1.0F, 1.0F, 0.0F});
  const LightPictures clear = rig().render(scene, march);
  scene.instances.erase(scene.instances.begin() + 1);
  const LightPictures none = rig().render(scene, march);
  const LightPictures opaque = rig().render(under_a_pane({0.5F, 0.5F, 0.5F, 1.0F}), march);
  scene.instances.push_back(place(make_box({2.0, 2.0, 0.01}), {0.0, 0.0, 2.5}, false));
  const LightPictures board = rig().render(scene, march);
  double off_clear = 0.0;
  double off_opaque = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < none.shafts.rgba.size(); ++i) {
    off_clear += std::pow(clear.shafts.rgba[i].g - none.shafts.rgba[i].g, 2.0);
    total += std::pow(board.shafts.rgba[i].g, 2.0);
    // Where the board itself is seen, rays end at it.
    if (opaque.distance.rgba[i].r != board.distance.rgba[i].r) continue;
    off_opaque += std::pow(opaque.shafts.rgba[i].g - board.shafts.rgba[i].g, 2.0);
    EXPECT_GE(opaque.shafts.rgba[i].g, 0.0F);
  }
  EXPECT_LT(std::sqrt(off_clear / total), 0.01);   // the shadow map's texels move with its fit
  EXPECT_LT(std::sqrt(off_opaque / total), 0.02);  // one is cut out of the light, the other taken from it
}

}  // namespace
}  // namespace render::test
