// Each technique comes to the reference as its parameters rise.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/testing/light_rig.h"
#include "tests/testing/truth.h"

namespace render::test {
namespace {

// Posts and a beam before a low sun.
SceneState posts(bool bounded) {
  SceneState scene = sunny(12.0, 24.0);
  scene.camera = look_at(128, 96, {0.0, 0.0, 1.5}, {0.0, 10.0, 2.0}, 50.0);
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true)};
  for (const double x : {-1.5, 0.5, 1.6}) {
    scene.instances.push_back(place(make_box({0.3F, 0.3F, 3.0F}), {x, 7.0, 1.5}, false));
  }
  scene.instances.push_back(place(make_box({4.0F, 0.3F, 0.3F}), {0.0, 7.0, 3.2}, false));
  scene.medium = Medium{.extinction_per_m = 0.06, .albedo = 0.9, .g = 0.5};
  if (bounded) scene.medium->extent = Box{{-6.0, 1.0, 0.0}, {6.0, 14.0, 5.0}};
  return scene;
}

// Half floats that were cut off, not rounded, would let 3e-4 less of the light through.
TEST(ShaftConvergence, LetsNoMoreAndNoLessThroughThanTheReferenceOnTheWhole) {
  const SceneState scene = posts(false);
  const ReferencePicture truth = truth_of(scene);
  const LightPictures found = rig().render(scene, parse_shaft_settings("closed-form:divisor=1"));
  double ratios = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
    if (truth.rgba[i].a < 0.01) continue;
    ratios += found.shafts.rgba[i].a / truth.rgba[i].a;
    ++count;
  }
  ASSERT_GT(count, 1000);
  EXPECT_NEAR(ratios / count, 1.0, 3e-5);
}

struct Rise {
  const char* coarse;
  const char* fine;
  double most;         // error of the fine one
  double share = 0.5;  // of the coarse one's error, at most
};

TEST(ShaftConvergence, EveryTechniqueComesToTheReferenceAsItsParametersRise) {
  for (const bool bounded : {false, true}) {
    const SceneState scene = posts(bounded);
    const ReferencePicture truth = truth_of(scene);
    // What is left is the shadow map's texels; of averages over tiles and of scaling up, what they smooth away.
    for (const Rise& rise :
         {Rise{"march:steps=16", "march:steps=1024", 0.006},
          Rise{"march:steps=16,spacing=growing", "march:steps=1024,spacing=growing", 0.006},
          Rise{"interleaved:steps=4,divisor=1", "interleaved:steps=512,divisor=1", 0.01, 0.9},
          Rise{"bilateral:steps=16,divisor=8", "bilateral:steps=512,divisor=2", 0.03},
          Rise{"epipolar:steps=16,line_px=8,tolerance=0.3", "epipolar:steps=1024,line_px=0.5,tolerance=0.005", 0.006},
          Rise{"minmax:line_px=16,tolerance=0.5", "minmax:line_px=0.5,tolerance=0.005", 0.006}}) {
      const double coarse =
          relative_rmse(rig().render(scene, parse_shaft_settings(rise.coarse)).shafts, truth.rgba, scene.exposure);
      const double fine =
          relative_rmse(rig().render(scene, parse_shaft_settings(rise.fine)).shafts, truth.rgba, scene.exposure);
      EXPECT_LT(fine, rise.share * coarse) << rise.fine << (bounded ? ", bounded" : "");
      EXPECT_LT(fine, rise.most) << rise.fine << (bounded ? ", bounded" : "");
    }
  }
}

// Beside the truth with the sun as a disc, here six times as wide as ours: as a point it leaves the edges too sharp.
TEST(ShaftSunDisc, SoftensTheShaftsAsTheReferenceDoes) {
  SceneState scene = posts(false);
  ensure_sun(scene).angular_radius_rad = 0.028;
  const ReferencePicture truth = truth_of(scene);
  struct Technique {
    const char* settings;
    double share;  // of the point's error, at most
  };
  for (const Technique& technique :
       {Technique{"march:steps=256", 0.5}, Technique{"epipolar:steps=256,line_px=1,tolerance=0.005", 0.5},
        Technique{"bilateral:steps=256,divisor=2", 0.9}}) {  // smooths edges by itself
    const auto error = [&](const char* sun) {
      return relative_rmse(rig().render(scene, parse_shaft_settings(std::string(technique.settings) + sun)).shafts,
                           truth.rgba, scene.exposure);
    };
    const double point = error(",sun=point");
    const double disc = error(",sun=disc");
    EXPECT_LT(disc, technique.share * point) << technique.settings << ": " << disc << " against " << point;
  }
}

TEST(ShaftSunDisc, OfNoWidthIsAPoint) {
  SceneState scene = posts(true);
  const LightPictures point = rig().render(scene, parse_shaft_settings("march:steps=256"));
  const LightPictures disc = rig().render(scene, parse_shaft_settings("march:steps=256,sun=disc"));
  double most = 0.0;
  double error = 0.0;
  for (std::size_t i = 0; i < point.shafts.rgba.size(); ++i) {
    most = std::max(most, double{point.shafts.rgba[i].r});
    error += std::pow(point.shafts.rgba[i].r - disc.shafts.rgba[i].r, 2.0);
  }
  // The comparisons of both are a texel apart.
  EXPECT_LT(std::sqrt(error / static_cast<double>(point.shafts.rgba.size())), 0.01 * most);
}

// A slab that the eye stands over shades nothing that it sees, so that the map need not hold it: the same shadows and
// shafts come from a sixteenth of the texels.
TEST(ShadowFitPicture, AMapWithoutTheGroundShowsTheSame) {
  SceneState scene = posts(false);
  scene.instances.front() = place(make_box({30.0F, 30.0F, 0.5F}), {0.0, 8.0, -0.25}, false);
  const ShaftSettings shafts = parse_shaft_settings("minmax:line_px=1,tolerance=0.005");
  const LightPictures left_out = rig().render(scene, shafts, 1024);
  auto whole = std::make_shared<Model>(*scene.instances.front().model);
  whole->convex_pieces.clear();
  scene.instances.front().model = whole;
  const LightPictures in_map = rig().render(scene, shafts, 4096);
  EXPECT_LT(relative_rmse(left_out.shafts, in_map.shafts.rgba), 0.006);
  EXPECT_LT(relative_rmse(left_out.added, in_map.added.rgba), 0.03);  // edges of shadows are a texel wide
}

}  // namespace
}  // namespace render::test
