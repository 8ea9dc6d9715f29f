// Shadow maps of their own for the medium that is seen.
#include "render/shadow/cascades.h"

#include <gtest/gtest.h>

#include "tests/testing/light_rig.h"
#include "tests/testing/truth.h"

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

struct MediumPicture {
  Pixels shafts;
  std::size_t parts = 0;
  bool own_map = false;
  unsigned revision = 0;
};

enum class Maps { Surfaces, OneForTheMedium, OfTheCascades };

class CascadesPicture : public ::testing::Test {
 protected:
  MediumPicture draw(const SceneState& scene, const std::string& shafts, Maps maps = Maps::OfTheCascades);
  // The surfaces' maps for each of the parts between those distances.
  Pixels draw_parted(const SceneState& scene, const std::string& shafts, const std::vector<double>& splits_m);

 private:
  // As CascadedShadow would have it that never parts the medium.
  Cascade unparted(const SceneState& scene, const View& view, GLuint depth);

  LightRig& light_ = rig();  // whose context must be there first
  CascadedShadow air_;
  VisibleDepthPass seen_;
  SunShadow one_map_;
};

Cascade CascadesPicture::unparted(const SceneState& scene, const View& view, GLuint depth) {
  const VisibleDepth seen = seen_.read(view, depth);
  std::array<ShadowFit, 2> fits;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    fits[i] = fit_to_visible_medium(rig().shadow.map(kOccluderKinds[i]).fit, kMapPx, view, *scene.medium, seen);
  }
  one_map_.update_parts(rig().shadow, fits, scene, rig().models);
  return {&one_map_, {}};
}

MediumPicture CascadesPicture::draw(const SceneState& scene, const std::string& shafts, Maps maps) {
  const View view = pinhole_view(scene.camera);
  rig().shadow.update(scene, view, kMapPx, rig().models);
  const ObjectsPicture& picture = rig().objects.draw(scene, view, rig().shadow, rig().models);
  Cascade part;
  if (maps == Maps::OneForTheMedium) part = unparted(scene, view, picture.depth);
  std::span<const Cascade> parts(&part, 1);
  if (maps == Maps::OfTheCascades) parts = air_.update(rig().shadow, scene, view, picture.depth, rig().models);
  if (maps == Maps::Surfaces) part.maps = &rig().shadow;
  const ShaftPicture& drawn =
      rig()
          .technique(parse_shaft_settings(shafts))
          .draw({.scene = scene, .view = view, .depth = picture.depth, .shadow = rig().shadow, .medium = parts});
  return {read_pixels(drawn.texture, drawn.width, drawn.height, GL_FLOAT), parts.size(),
          parts.front().maps != &rig().shadow, parts.front().maps->map(Occluders::Virtual).revision};
}

Pixels CascadesPicture::draw_parted(const SceneState& scene, const std::string& shafts,
                                    const std::vector<double>& splits_m) {
  const View view = pinhole_view(scene.camera);
  rig().shadow.update(scene, view, kMapPx, rig().models);
  const ObjectsPicture& picture = rig().objects.draw(scene, view, rig().shadow, rig().models);
  std::vector<Cascade> parts{{&rig().shadow, {}}};
  for (const double split_m : splits_m) {
    parts.back().range.to_m = split_m;
    parts.push_back({&rig().shadow, {.from_m = split_m}});
  }
  const ShaftPicture& drawn =
      rig()
          .technique(parse_shaft_settings(shafts))
          .draw({.scene = scene, .view = view, .depth = picture.depth, .shadow = rig().shadow, .medium = parts});
  return read_pixels(drawn.texture, drawn.width, drawn.height, GL_FLOAT);
}

constexpr std::array<const char*, 4> kPartedTechniques{
    "march:steps=1024", "epipolar:steps=1024,line_px=1,sample_px=4,tolerance=0.01",
    "minmax:line_px=1.1,sample_px=4,tolerance=0.01", "minmax:line_px=0.5,sample_px=4,tolerance=0.01"};

TEST_F(CascadesPicture, PartsOfTheAirAddUpToAllOfIt) {
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

TEST_F(CascadesPicture, SealedBoxStaysAtZeroInAllParts) {
  const SceneState scene = in_sealed_room();
  for (const char* shafts : kPartedTechniques) {
    EXPECT_EQ(brightest(draw_parted(scene, shafts, {0.7, 2.1})), 0.0F) << shafts;
  }
}

// A thing farther and farther away: depth in 16 bits, then in 32, at last in trees whose steps are centimetres.
TEST_F(CascadesPicture, SealedBoxStaysAtZeroHoweverDeepItsMapIs) {
  SceneState scene = in_sealed_room();
  for (const double far_m : {50.0, 100.0, 150.0, 200.0, 300.0, 700.0, 1600.0, 4000.0}) {
    scene.instances.resize(1);
    scene.instances.push_back(place(make_box({2.0F, 2.0F, 2.0F}), {0.5 * far_m, far_m, 1.0}, false));
    for (const char* shafts : kPartedTechniques) {
      const MediumPicture found = draw(scene, shafts, Maps::OneForTheMedium);
      EXPECT_EQ(brightest(found.shafts), 0.0F) << shafts << " " << far_m << " m";
    }
  }
}

TEST_F(CascadesPicture, IsNearerToTheTruthThanTheSurfacesMap) {
  const SceneState scene = posts_near_and_far();
  const ReferencePicture truth = truth_of(scene);
  for (const char* shafts : {"march:steps=1024", "minmax:line_px=1.1,sample_px=8,tolerance=0.01"}) {
    const MediumPicture coarse = draw(scene, shafts, Maps::Surfaces);
    const MediumPicture fine = draw(scene, shafts);
    ASSERT_TRUE(fine.own_map);
    EXPECT_LT(relative_rmse(fine.shafts, truth.rgba, scene.exposure),
              0.7 * relative_rmse(coarse.shafts, truth.rgba, scene.exposure))
        << shafts;
  }
}

// A colonnade of 400 m, seen from between its columns, in thick medium.
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

TEST_F(CascadesPicture, IsPartedWhereTexelsAreWideNearTheEye) {
  const SceneState scene = colonnade();
  const ReferencePicture truth = truth_of(scene);
  for (const char* shafts : kPartedTechniques) {
    const MediumPicture coarse = draw(scene, shafts, Maps::OneForTheMedium);
    const MediumPicture fine = draw(scene, shafts);
    EXPECT_GT(fine.parts, 1U);
    // Two parts; a third of the error at least, for a map as large again.
    EXPECT_LT(relative_rmse(fine.shafts, truth.rgba, scene.exposure),
              0.33 * relative_rmse(coarse.shafts, truth.rgba, scene.exposure))
        << shafts;
  }
}

TEST_F(CascadesPicture, StillSceneIsBitEqualAndItsMapIsNotRenderedAgain) {
  const SceneState scene = posts_near_and_far();
  const MediumPicture first = draw(scene, "march:steps=64");
  const MediumPicture again = draw(scene, "march:steps=64");
  EXPECT_TRUE(first.shafts == again.shafts);
  EXPECT_EQ(first.revision, again.revision);
  SceneState moved = scene;
  moved.instances[1].world_from_model[3].x += 0.2;
  EXPECT_GT(draw(moved, "march:steps=64").revision, first.revision);
}

// Both maps may have been rendered equally often.
TEST_F(CascadesPicture, TechniquesTellItFromTheSurfacesMap) {
  const SceneState scene = posts_near_and_far();
  // The same settings in other words are another technique of the rig.
  const MediumPicture coarse = draw(scene, "march:steps=66,divisor=1", Maps::Surfaces);
  draw(scene, "march:steps=66");
  const MediumPicture coarse_after_fine = draw(scene, "march:steps=66", Maps::Surfaces);
  EXPECT_TRUE(coarse.shafts == coarse_after_fine.shafts);
}

TEST_F(CascadesPicture, TakesTheSurfacesMapWhereItsOwnWouldBeHardlyFiner) {
  SceneState scene = posts_near_and_far();
  scene.camera = look_at(128, 96, {0.0, -60.0, 1.5}, {0.0, 10.0, 8.0}, 60.0);  // sees all of it
  EXPECT_FALSE(draw(scene, "march:steps=64").own_map);
}

}  // namespace
}  // namespace render::test
