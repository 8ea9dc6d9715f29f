// Shadow maps of their own for the air that is seen.
#include "render/shadow/air_shadow.h"

#include <gtest/gtest.h>

#include "tests/golden/light/light_rig.h"
#include "tests/golden/light/truth.h"

namespace render::test {
namespace {

constexpr int kMapPx = 512;

// Posts before a wall, lit from the side, and others far to the side that nobody sees.
SceneState posts_near_and_far() {
  SceneState scene = sunny(75.0, 35.0);
  scene.camera = look_at(128, 96, {0.0, 0.0, 1.5}, {0.0, 10.0, 1.4}, 40.0);
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true)};
  for (const double x : {-1.5, 0.5, 1.6, -24.0, 24.0}) {
    scene.instances.push_back(place(make_box({0.3F, 0.3F, 3.0F}), {x, 6.0, 1.5}, false));
  }
  scene.instances.push_back(place(make_box({9.0F, 0.3F, 6.0F}), {0.0, 9.0, 3.0}, false));
  scene.medium = Medium{.extinction_per_m = 0.06, .albedo = 0.9, .g = 0.5};
  return scene;
}

struct AirPicture {
  Pixels shafts;
  std::size_t parts = 0;
  bool own_map = false;
  unsigned revision = 0;
};

enum class Maps { Surfaces, OneForTheAir, OfTheAirsParts };

class AirShadowPicture : public ::testing::Test {
 protected:
  AirPicture draw(const SceneState& scene, const std::string& shafts, Maps maps = Maps::OfTheAirsParts);
  // The surfaces' maps for each of the parts between those distances.
  Pixels draw_parted(const SceneState& scene, const std::string& shafts, const std::vector<double>& splits_m);

 private:
  // As AirShadow would have it that never parts the air.
  AirPart unparted(const SceneState& scene, const View& view, GLuint depth);

  LightRig& light_ = rig();  // whose context must be there first
  AirShadow air_;
  SeenDepthPass seen_;
  SunShadow one_map_;
};

AirPart AirShadowPicture::unparted(const SceneState& scene, const View& view, GLuint depth) {
  const SeenDepth seen = seen_.read(view, depth);
  std::array<ShadowFit, 2> fits;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fits[i] = fit_to_seen_air(rig().shadow.map(kCasterKinds[i]).fit, kMapPx, view, *scene.medium, seen);
  }
  one_map_.update_parts(rig().shadow, fits, scene, rig().models);
  return {&one_map_, {}};
}

AirPicture AirShadowPicture::draw(const SceneState& scene, const std::string& shafts, Maps maps) {
  const View view = pinhole_view(scene.camera);
  rig().shadow.update(scene, view, kMapPx, rig().models);
  const ObjectsPicture& picture = rig().objects.draw(scene, view, rig().shadow, rig().models);
  AirPart part;
  if (maps == Maps::OneForTheAir) part = unparted(scene, view, picture.depth);
  std::span<const AirPart> parts(&part, 1);
  if (maps == Maps::OfTheAirsParts) parts = air_.update(rig().shadow, scene, view, picture.depth, rig().models);
  if (maps == Maps::Surfaces) part.maps = &rig().shadow;
  const ShaftPicture& drawn =
      rig()
          .technique(parse_shaft_settings(shafts))
          .draw({.scene = scene, .view = view, .depth = picture.depth, .shadow = rig().shadow, .air = parts});
  return {read_pixels(drawn.texture, drawn.width, drawn.height, GL_FLOAT), parts.size(),
          parts.front().maps != &rig().shadow, parts.front().maps->map(Casters::Virtual).revision};
}

Pixels AirShadowPicture::draw_parted(const SceneState& scene, const std::string& shafts,
                                     const std::vector<double>& splits_m) {
  const View view = pinhole_view(scene.camera);
  rig().shadow.update(scene, view, kMapPx, rig().models);
  const ObjectsPicture& picture = rig().objects.draw(scene, view, rig().shadow, rig().models);
  std::vector<AirPart> parts{{&rig().shadow, {}}};
  for (const double split_m : splits_m) {
    parts.back().range.to_m = split_m;
    parts.push_back({&rig().shadow, {.from_m = split_m}});
  }
  const ShaftPicture& drawn =
      rig()
          .technique(parse_shaft_settings(shafts))
          .draw({.scene = scene, .view = view, .depth = picture.depth, .shadow = rig().shadow, .air = parts});
  return read_pixels(drawn.texture, drawn.width, drawn.height, GL_FLOAT);
}

constexpr std::array<const char*, 4> kPartedTechniques{
    "march:steps=1024", "epipolar:steps=1024,line_px=1,sample_px=4,tolerance=0.01",
    "minmax:line_px=1.1,sample_px=4,tolerance=0.01", "minmax:line_px=0.5,sample_px=4,tolerance=0.01"};

TEST_F(AirShadowPicture, PartsOfTheAirAddUpToAllOfIt) {
  SceneState scene = posts_near_and_far();
  scene.camera = look_at(64, 48, {0.0, 0.0, 1.5}, {0.0, 10.0, 1.4}, 40.0);
  const Medium endless = *scene.medium;
  Medium bounded = endless;
  bounded.extent = Box{{-7.0, 2.0, 0.0}, {7.0, 8.5, 4.0}};
  bounded.falloff = HeightFalloff{.base_m = 0.0, .scale_height_m = 2.0};
  for (const Medium& medium : {endless, bounded}) {
    scene.medium = medium;
    for (const char* shafts : kPartedTechniques) {
      const Pixels whole = draw_parted(scene, shafts, {});
      const Pixels parted = draw_parted(scene, shafts, {3.0, 6.1, 7.3});
      // Sums of four half floats; marches of other steps.
      EXPECT_LT(relative_rmse(parted, whole.rgba), 4e-3) << shafts << (medium.extent ? ", bounded" : "");
      for (std::size_t p = 0; p < whole.rgba.size(); ++p) ASSERT_EQ(parted.rgba[p].a, whole.rgba[p].a) << shafts;
    }
  }
}

SceneState in_sealed_room() {
  SceneState scene = sunny(30.0, 35.0, 0.0);
  scene.camera = look_at(202, 151, {0.0, 0.0, 1.5}, {0.0, 10.0, 1.5}, 70.0);
  scene.instances = {place(sealed_room(), {0.0, 0.0, 1.5}, false)};
  scene.medium = Medium{.extinction_per_m = 0.5, .albedo = 0.9, .g = 0.5};
  return scene;
}

TEST_F(AirShadowPicture, SealedBoxStaysAtZeroInAllParts) {
  const SceneState scene = in_sealed_room();
  for (const char* shafts : kPartedTechniques) {
    EXPECT_EQ(brightest(draw_parted(scene, shafts, {0.7, 2.1})), 0.0F) << shafts;
  }
}

// A thing farther and farther away: depth in 16 bits, then in 32, at last in trees whose steps are centimetres.
TEST_F(AirShadowPicture, SealedBoxStaysAtZeroHoweverDeepItsMapIs) {
  SceneState scene = in_sealed_room();
  for (const double far_m : {50.0, 100.0, 150.0, 200.0, 300.0, 700.0, 1600.0, 4000.0}) {
    scene.instances.resize(1);
    scene.instances.push_back(place(make_box({2.0F, 2.0F, 2.0F}), {0.5 * far_m, far_m, 1.0}, false));
    for (const char* shafts : kPartedTechniques) {
      const AirPicture found = draw(scene, shafts, Maps::OneForTheAir);
      EXPECT_EQ(brightest(found.shafts), 0.0F) << shafts << " " << far_m << " m";
    }
  }
}

TEST_F(AirShadowPicture, IsNearerToTheTruthThanTheSurfacesMap) {
  const SceneState scene = posts_near_and_far();
  const ReferencePicture truth = truth_of(scene);
  for (const char* shafts : {"march:steps=1024", "minmax:line_px=1.1,sample_px=8,tolerance=0.01"}) {
    const AirPicture coarse = draw(scene, shafts, Maps::Surfaces);
    const AirPicture fine = draw(scene, shafts);
    ASSERT_TRUE(fine.own_map);
    EXPECT_LT(relative_rmse(fine.shafts, truth.rgba, scene.exposure),
              0.7 * relative_rmse(coarse.shafts, truth.rgba, scene.exposure))
        << shafts;
  }
}

// A colonnade of 400 m, seen from between its columns, in thick air.
SceneState colonnade() {
  SceneState scene = sunny(65.0, 30.0);
  scene.camera = look_at(128, 96, {0.0, -2.0, 1.6}, {0.3, 10.0, 2.0}, 50.0);
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true)};
  for (int i = 0; i < 100; ++i) {
    for (const double x : {-3.0, 3.0}) {
      scene.instances.push_back(place(make_box({0.25F, 0.25F, 4.0F}), {x, 1.0 + 4.0 * i, 2.0}, false));
    }
  }
  scene.medium = Medium{.extinction_per_m = 0.03, .albedo = 0.9, .g = 0.5};
  return scene;
}

TEST_F(AirShadowPicture, IsPartedWhereTexelsAreWideNearTheEye) {
  const SceneState scene = colonnade();
  const ReferencePicture truth = truth_of(scene);
  for (const char* shafts : kPartedTechniques) {
    const AirPicture coarse = draw(scene, shafts, Maps::OneForTheAir);
    const AirPicture fine = draw(scene, shafts);
    EXPECT_GT(fine.parts, 1U);
    // Two parts; a third of the error at least, for a map as large again.
    EXPECT_LT(relative_rmse(fine.shafts, truth.rgba, scene.exposure),
              0.33 * relative_rmse(coarse.shafts, truth.rgba, scene.exposure))
        << shafts;
  }
}

TEST_F(AirShadowPicture, StillSceneIsBitEqualAndItsMapIsNotRenderedAgain) {
  const SceneState scene = posts_near_and_far();
  const AirPicture first = draw(scene, "march:steps=64");
  const AirPicture again = draw(scene, "march:steps=64");
  EXPECT_TRUE(first.shafts == again.shafts);
  EXPECT_EQ(first.revision, again.revision);
  SceneState moved = scene;
  moved.instances[1].world_from_model[3].x += 0.2;
  EXPECT_GT(draw(moved, "march:steps=64").revision, first.revision);
}

// Both maps may have been rendered equally often.
TEST_F(AirShadowPicture, TechniquesTellItFromTheSurfacesMap) {
  const SceneState scene = posts_near_and_far();
  // The same settings in other words are another technique of the rig.
  const AirPicture coarse = draw(scene, "march:steps=66,divisor=1", Maps::Surfaces);
  draw(scene, "march:steps=66");
  const AirPicture coarse_after_fine = draw(scene, "march:steps=66", Maps::Surfaces);
  EXPECT_TRUE(coarse.shafts == coarse_after_fine.shafts);
}

TEST_F(AirShadowPicture, TakesTheSurfacesMapWhereItsOwnWouldBeHardlyFiner) {
  SceneState scene = posts_near_and_far();
  scene.camera = look_at(128, 96, {0.0, -60.0, 1.5}, {0.0, 10.0, 8.0}, 60.0);  // sees all of it
  EXPECT_FALSE(draw(scene, "march:steps=64").own_map);
}

}  // namespace
}  // namespace render::test
