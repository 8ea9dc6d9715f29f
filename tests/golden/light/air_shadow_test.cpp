// Shadow maps of their own for the air that is seen.
#include "render/shadow/air_shadow.h"

#include <gtest/gtest.h>

#include "render/shafts/reference/shaft_reference.h"
#include "tests/golden/light/light_rig.h"

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
  bool own_map = false;
  unsigned revision = 0;
};

class AirShadowPicture : public ::testing::Test {
 protected:
  LightRig& light = rig();  // whose context must be there first
  AirShadow air;
};

AirPicture draw(AirShadow& air, const SceneState& scene, const char* shafts, bool fitted) {
  const View view = pinhole_view(scene.camera);
  rig().shadow.update(scene, view, kMapPx, rig().models);
  const ObjectsPicture& picture = rig().objects.draw(scene, view, rig().shadow, rig().models);
  const SunShadow& casters = air.update(rig().shadow, scene, view, picture.depth, rig().models);
  const ShaftPicture& drawn = rig()
                                  .technique(parse_shaft_settings(shafts))
                                  .draw({.scene = scene,
                                         .view = view,
                                         .depth = picture.depth,
                                         .shadow = rig().shadow,
                                         .air_shadow = fitted ? &casters : nullptr});
  return {read_pixels(drawn.texture, drawn.width, drawn.height, GL_FLOAT), &casters != &rig().shadow,
          casters.map(Casters::Virtual).revision};
}

TEST_F(AirShadowPicture, IsNearerToTheTruthThanTheSurfacesMap) {
  const SceneState scene = posts_near_and_far();
  std::vector<float> axis_m;
  for (const glm::vec4& p : rig().render(scene, parse_shaft_settings("closed-form:divisor=1")).distance.rgba) {
    axis_m.push_back(p.r);
  }
  const ReferencePicture truth =
      ShaftReference(scene, {.sky = ReferenceSky::Open}).picture(pinhole_view(scene.camera), axis_m);
  for (const char* shafts : {"march:steps=1024", "minmax:line_px=1.1,sample_px=8,tolerance=0.01"}) {
    const AirPicture coarse = draw(air, scene, shafts, false);
    const AirPicture fine = draw(air, scene, shafts, true);
    ASSERT_TRUE(fine.own_map);
    EXPECT_LT(relative_rmse(fine.shafts, truth.rgba, scene.exposure),
              0.7 * relative_rmse(coarse.shafts, truth.rgba, scene.exposure))
        << shafts;
  }
}

TEST_F(AirShadowPicture, StillSceneIsBitEqualAndItsMapIsNotRenderedAgain) {
  const SceneState scene = posts_near_and_far();
  const AirPicture first = draw(air, scene, "march:steps=64", true);
  const AirPicture again = draw(air, scene, "march:steps=64", true);
  EXPECT_TRUE(first.shafts == again.shafts);
  EXPECT_EQ(first.revision, again.revision);
  SceneState moved = scene;
  moved.instances[1].world_from_model[3].x += 0.2;
  EXPECT_GT(draw(air, moved, "march:steps=64", true).revision, first.revision);
}

// Both maps may have been rendered equally often.
TEST_F(AirShadowPicture, TechniquesTellItFromTheSurfacesMap) {
  const SceneState scene = posts_near_and_far();
  // The same settings in other words are another technique of the rig.
  const AirPicture coarse = draw(air, scene, "march:steps=66,divisor=1", false);
  draw(air, scene, "march:steps=66", true);
  const AirPicture coarse_after_fine = draw(air, scene, "march:steps=66", false);
  EXPECT_TRUE(coarse.shafts == coarse_after_fine.shafts);
}

TEST_F(AirShadowPicture, TakesTheSurfacesMapWhereItsOwnWouldBeHardlyFiner) {
  SceneState scene = posts_near_and_far();
  scene.camera = look_at(128, 96, {0.0, -60.0, 1.5}, {0.0, 10.0, 8.0}, 60.0);  // sees all of it
  EXPECT_FALSE(draw(air, scene, "march:steps=64", true).own_map);
}

}  // namespace
}  // namespace render::test
