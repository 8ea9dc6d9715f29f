// What a scene requires, and what it does not.

#include "render/plan/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/plan/features/features.h"
#include "render/plan/screen_region.h"

namespace {

using render::Plan;
using render::SceneState;
using render::Target;
using testing::ElementsAre;
using testing::HasSubstr;
namespace feature = render::feature;

render::Instance box(bool real) {
  return {"box", std::make_shared<render::Model>(render::make_box({1.0F, 1.0F, 1.0F})), glm::dmat4(1.0), real};
}

SceneState sunlit_scene() {
  SceneState scene;
  scene.camera.width = 640;
  scene.camera.height = 480;
  scene.camera.fx = scene.camera.fy = 500.0;
  scene.camera.cx = 320.0;
  scene.camera.cy = 240.0;
  ensure_sun(scene).direction_in_world = glm::normalize(glm::dvec3(0.0, -1.0, 1.0));
  ensure_sun(scene).illuminance_rgb = glm::dvec3(90000.0);
  return scene;
}

render::Medium haze() {
  render::Medium medium;
  medium.extinction_per_m = 0.1;
  return medium;
}

Plan plan_of(const SceneState& scene, const render::Quality& quality = {}, Target target = Target::Video) {
  return render::make_plan(scene, quality, target);
}

std::vector<std::string> names(const Plan& plan) {
  std::vector<std::string> out;
  for (const render::Pass& pass : plan.passes) out.emplace_back(pass.feature->name);
  return out;
}

std::string omission(const Plan& plan, const std::string& name) {
  for (const render::Omission& o : plan.omitted) {
    if (o.feature->name == name) return o.reason;
  }
  return "";
}

TEST(Plan, AnEmptySceneIsPassedThrough) {
  const Plan plan = plan_of(sunlit_scene());
  EXPECT_TRUE(plan.passes.empty());
  EXPECT_THAT(omission(plan, "composite"), HasSubstr("no objects and no medium"));
}

TEST(Plan, NothingIsDrawnWhileThePoseIsUnknown) {
  SceneState scene = sunlit_scene();
  scene.instances.push_back(box(false));
  scene.medium = haze();
  scene.draw_virtual = false;
  const Plan plan = plan_of(scene);
  EXPECT_TRUE(plan.passes.empty());
  EXPECT_THAT(omission(plan, "objects"), HasSubstr("pose"));
}

TEST(Plan, AThingInTheSunNeedsShadowAndObjectsButNoShafts) {
  SceneState scene = sunlit_scene();
  scene.instances.push_back(box(false));
  const Plan plan = plan_of(scene);
  EXPECT_TRUE(plan.has(feature::kShadow));
  EXPECT_TRUE(plan.has(feature::kObjects));
  EXPECT_TRUE(plan.has(feature::kComposite));
  EXPECT_FALSE(plan.has(feature::kShafts));
  EXPECT_THAT(omission(plan, "shafts"), HasSubstr("no medium"));
}

TEST(Plan, WithoutTheSunThereIsNoShadowMap) {
  SceneState scene = sunlit_scene();
  scene.instances.push_back(box(false));
  scene.medium = haze();
  ensure_sun(scene).illuminance_rgb = glm::dvec3(0.0);
  const Plan plan = plan_of(scene);
  EXPECT_FALSE(plan.has(feature::kShadow));
  EXPECT_THAT(omission(plan, "shadow"), HasSubstr("no sunlight"));
  EXPECT_EQ(plan.quality.shafts.technique, "closed-form");
}

TEST(Plan, AnOpenMediumIsSolvedInClosedForm) {
  SceneState scene = sunlit_scene();
  scene.medium = haze();
  const Plan plan = plan_of(scene);
  EXPECT_TRUE(plan.has(feature::kShafts));
  EXPECT_EQ(plan.quality.shafts.technique, "closed-form");
  EXPECT_FALSE(plan.has(feature::kObjects));
  EXPECT_FALSE(plan.has(feature::kShadow));
}

TEST(Plan, OccludersInAMediumAreInterleaved) {
  SceneState scene = sunlit_scene();
  scene.instances.push_back(box(false));
  scene.medium = haze();
  EXPECT_EQ(plan_of(scene).quality.shafts.technique, "interleaved");
}

TEST(Plan, OccludersThatCannotShadowTheMediumCarveNoShafts) {
  SceneState scene = sunlit_scene();  // the sun stands in the south, 45 degrees high
  scene.instances.push_back(box(false));
  scene.medium = haze();
  scene.medium->extent = render::Box{{-1.0, -6.0, 0.0}, {1.0, -4.0, 1.0}};  // on the box's sunny side
  const Plan sunny_side = plan_of(scene);
  EXPECT_EQ(sunny_side.quality.shafts.technique, "closed-form");
  EXPECT_TRUE(sunny_side.has(feature::kShadow)) << "the box may still shade itself";
  scene.medium->extent = render::Box{{-1.0, 1.0, -3.0}, {1.0, 3.0, -1.0}};
  EXPECT_EQ(plan_of(scene).quality.shafts.technique, "interleaved");
  scene.medium->extent = render::Box{{0.51, 1.0, -3.0}, {1.0, 3.0, -1.0}};  // a centimetre beside its shadow
  EXPECT_EQ(plan_of(scene).quality.shafts.technique, "closed-form");
  ensure_sun(scene).angular_radius_rad = 0.00465;  // and within the penumbra
  EXPECT_EQ(plan_of(scene).quality.shafts.technique, "interleaved");
}

TEST(Plan, NoShadowMapWhereShadowsFallOnNothingDrawn) {
  SceneState scene = sunlit_scene();
  scene.instances.push_back(box(true));
  scene.medium = haze();
  scene.medium->extent = render::Box{{-1.0, -6.0, 0.0}, {1.0, -4.0, 1.0}};
  const Plan plan = plan_of(scene);
  EXPECT_FALSE(plan.has(feature::kShadow));
  EXPECT_THAT(omission(plan, "shadow"), HasSubstr("into the medium"));
}

TEST(Plan, AMediumWithoutExtinctionIsNone) {
  SceneState scene = sunlit_scene();
  scene.instances.push_back(box(false));
  scene.medium = haze();
  scene.medium->extinction_per_m = 0.0;
  const Plan plan = plan_of(scene);
  EXPECT_FALSE(plan.has(feature::kShafts));
  EXPECT_THAT(omission(plan, "shafts"), HasSubstr("extinction is zero"));
}

TEST(Plan, RealThingsAloneChangeNothing) {
  SceneState scene = sunlit_scene();
  scene.instances.push_back(box(true));
  EXPECT_TRUE(plan_of(scene).passes.empty());
}

TEST(Plan, RunsInTheOrderInWhichPassesNeedEachOther) {
  SceneState scene = sunlit_scene();
  scene.instances = {box(false), box(true)};
  scene.medium = haze();
  render::Quality quality;
  quality.shafts = render::parse_shaft_settings("march");
  EXPECT_THAT(names(plan_of(scene, quality)),
              ElementsAre("shadow", "objects", "cascades", "shafts", "upload", "composite", "read"))
      << "how much of the real picture is uploaded depends on what was drawn";
  EXPECT_THAT(names(plan_of(scene, quality, Target::Still)),
              ElementsAre("background", "shadow", "objects", "cascades", "shafts", "composite", "read"));
  EXPECT_THAT(names(plan_of(scene, quality, Target::Medium)),
              ElementsAre("shadow", "objects", "cascades", "shafts", "medium"));
}

TEST(Plan, SmallLayersAreMergedAndLaidOverTheVideoOutsideTheGl) {
  SceneState scene = sunlit_scene();
  scene.medium = haze();
  render::Quality quality;
  quality.render_scale = 0.5;
  EXPECT_THAT(names(plan_of(scene, quality)), ElementsAre("shafts", "merge", "read", "overlay"));
  EXPECT_THAT(names(plan_of(scene, quality, Target::Still)), ElementsAre("background", "shafts", "composite", "read"))
      << "stills are drawn at full size";
}

TEST(Plan, AStillOfAnEmptySceneShowsItsBackground) {
  const Plan plan = plan_of(sunlit_scene(), {}, Target::Still);
  EXPECT_THAT(names(plan), ElementsAre("background", "composite", "read"));
  EXPECT_EQ(omission(plan, "objects"), "the scene has no objects and no medium");
}

TEST(Plan, TranslucentOccludersTintTheShaftsOfTechniquesThatLeaveItToThem) {
  SceneState scene = sunlit_scene();
  scene.instances.push_back(box(false));
  EXPECT_THAT(omission(plan_of(scene), "translucency"), HasSubstr("no medium"));
  scene.medium = haze();
  EXPECT_THAT(omission(plan_of(scene), "translucency"), HasSubstr("no occluder lets coloured light through"));
  render::Model pane = render::make_box({1.0F, 1.0F, 0.1F});
  for (render::Material& material : pane.materials) material.alpha_mode = render::AlphaMode::Blend;
  scene.instances.push_back({"pane", std::make_shared<render::Model>(std::move(pane)), glm::dmat4(1.0), false});
  EXPECT_THAT(names(plan_of(scene)),
              ElementsAre("shadow", "objects", "shafts", "translucency", "upload", "composite", "read"));
  render::Quality quality;
  for (const render::ShaftTechniqueInfo& info : render::shaft_techniques()) {
    quality.shafts.technique = info.name;
    EXPECT_NE(plan_of(scene, quality).has(feature::kTranslucency), info.handles_translucency) << info.name;
  }
}

TEST(Plan, AMapOfTheAirIsLeftOutWhereItsTexelsAreNotSeen) {
  SceneState scene = sunlit_scene();
  scene.instances.push_back(box(false));
  EXPECT_THAT(omission(plan_of(scene), "cascades"), HasSubstr("no medium"));
  scene.medium = haze();
  EXPECT_THAT(omission(plan_of(scene), "cascades"), HasSubstr("interleaved does not show"));
  render::Quality quality;
  quality.shafts = render::parse_shaft_settings("march:sun=disc");
  EXPECT_THAT(omission(plan_of(scene, quality), "cascades"), HasSubstr("disc"));
  quality.shafts = render::parse_shaft_settings("march");
  EXPECT_TRUE(plan_of(scene, quality).has(feature::kCascades));
}

render::View level_view() {
  render::View view;
  view.width = 640;
  view.height = 480;
  view.focal_px = {500.0, 500.0};
  view.centre_px = {320.0, 240.0};
  return view;  // looks along the world's z
}

TEST(MediumRegion, IsTheBoxOnTheScreen) {
  render::Medium medium = haze();
  medium.extent = render::Box{{-1.0, -0.5, 10.0}, {1.0, 0.5, 20.0}};
  const render::PixelRect r = render::medium_region(level_view(), medium);
  EXPECT_EQ(r.x, 270);  // 320 - 500 / 10
  EXPECT_EQ(r.width, 100);
  EXPECT_EQ(r.y, 215);
  EXPECT_EQ(r.height, 50);
}

TEST(MediumRegion, IsEverythingWhenTheEyeIsInsideOrThereAreNoBounds) {
  render::Medium medium = haze();
  EXPECT_EQ(render::medium_region(level_view(), medium).width, 640);
  medium.extent = render::Box{{-1.0, -1.0, -5.0}, {1.0, 1.0, 5.0}};
  EXPECT_EQ(render::medium_region(level_view(), medium).width, 640);
}

TEST(MediumRegion, IsEmptyBehindTheCamera) {
  render::Medium medium = haze();
  medium.extent = render::Box{{-1.0, -1.0, -5.0}, {1.0, 1.0, -2.0}};
  EXPECT_TRUE(render::medium_region(level_view(), medium).empty());
}

}  // namespace
