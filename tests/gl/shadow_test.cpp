#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/testing/light_rig.h"

namespace render::test {
namespace {

constexpr glm::dvec3 kNorth{0.0, 1.0, 0.0};  // `up` of a camera that looks straight down: north is up in the picture

Instance ground() {
  return place(make_ground(), glm::dvec3(0.0), true);
}

// A scene seen straight from above, 4 m wide: one pixel is 4 / 800 m.
SceneState from_above(double azimuth_deg, double elevation_deg) {
  SceneState scene = sunny(azimuth_deg, elevation_deg);
  const double fov_deg = 2.0 * glm::degrees(std::atan(2.0 / 40.0));
  scene.camera = look_at(800, 800, {0.0, 0.0, 40.0}, {0.0, 0.0, 0.0}, fov_deg, kNorth);
  scene.instances = {ground()};
  return scene;
}

bool shadowed(const LightPictures& pictures, int x, int y) {
  return pictures.multiplier.at(x, y).r < 0.7F && pictures.added.at(x, y).r == 0.0F;
}

// Direction, clockwise from north, in which the shadow's pixels lie from the picture's centre: principal axis, by
// least squares through the post's foot.
double shadow_azimuth_deg(const LightPictures& pictures) {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  glm::dvec2 mean(0.0);
  for (int y = 0; y < 800; ++y) {
    for (int x = 0; x < 800; ++x) {
      if (!shadowed(pictures, x, y)) continue;
      const glm::dvec2 p(x + 0.5 - 400.0, 400.0 - y - 0.5);
      mean += p;
      xx += p.x * p.x;
      xy += p.x * p.y;
      yy += p.y * p.y;
    }
  }
  double axis = 0.5 * std::atan2(2.0 * xy, xx - yy);  // from east, counter-clockwise
  if (mean.x * std::cos(axis) + mean.y * std::sin(axis) < 0.0) axis += glm::radians(180.0);
  return 90.0 - glm::degrees(axis);
}

TEST(SunShadowPicture, PostsShadowPointsAwayFromTheSunAtSeveralAzimuths) {
  for (const double azimuth : {12.0, 101.0, 187.5, 263.0, 330.0}) {
    for (const double elevation : {25.0, 50.0}) {
      SceneState scene = from_above(azimuth, elevation);
      scene.instances.push_back(place(make_box({0.02, 0.02, 0.7}), {0.0, 0.0, 0.35}, false));
      const LightPictures pictures = rig().render(scene);
      const double off = std::remainder(shadow_azimuth_deg(pictures) - (azimuth + 180.0), 360.0);
      EXPECT_LT(std::abs(off), 0.5) << "sun azimuth " << azimuth << ", elevation " << elevation;
    }
  }
}

TEST(SunShadowPicture, PostsShadowIsAsLongAsTheSunIsLow) {
  for (const double elevation : {25.0, 50.0, 75.0}) {
    SceneState scene = from_above(180.0, elevation);
    scene.instances.push_back(place(make_box({0.02, 0.02, 0.7}), {0.0, 0.0, 0.35}, false));
    const LightPictures pictures = rig().render(scene);
    dump(pictures, "post_" + std::to_string(static_cast<int>(elevation)));
    int last = 400;
    for (int y = 0; y < 400; ++y) {
      if (shadowed(pictures, 400, y)) {
        last = y;
        break;
      }
    }
    // The shadow runs north from the post's upper northern edge, 0.01 m off the axis.
    const double expected_m = 0.7 / std::tan(glm::radians(elevation)) + 0.01;
    EXPECT_NEAR((400 - last) * 0.005, expected_m, 0.012) << "elevation " << elevation;  // two pixels
  }
}

// Acne shows as specks, peter-panning as a gap at the foot.
TEST(SunShadowPicture, ShadowOfABoxIsWholeAndStartsAtItsFoot) {
  for (const double elevation : {8.0, 35.0, 80.0}) {
    SceneState scene = from_above(180.0, elevation);
    scene.instances.push_back(place(make_box({0.5, 0.5, 0.1}), {0.0, 0.0, 0.05}, false));
    const LightPictures pictures = rig().render(scene);
    const double length_m = 0.1 / std::tan(glm::radians(elevation));
    int lit_inside = 0;
    int dark_outside = 0;
    for (int y = 0; y < 800; ++y) {
      for (int x = 0; x < 800; ++x) {
        if (pictures.added.at(x, y).r > 0.0F || pictures.multiplier.at(x, y).r == 0.0F) continue;  // the box
        const glm::dvec2 p((x + 0.5 - 400.0) * 0.005, (400.0 - y - 0.5) * 0.005);
        const double inside = std::min({0.25 - std::abs(p.x), p.y - 0.25, 0.25 + length_m - p.y});
        const double outside = std::max({std::abs(p.x) - 0.25, std::abs(p.y) - 0.25 - length_m});
        if (inside > 0.01 && pictures.multiplier.at(x, y).r > 0.75F) ++lit_inside;
        if (outside > 0.01 && pictures.multiplier.at(x, y).r < 0.999F) ++dark_outside;
      }
    }
    EXPECT_EQ(lit_inside, 0) << "elevation " << elevation;
    EXPECT_EQ(dark_outside, 0) << "elevation " << elevation;
  }
}

TEST(SunShadowPicture, DepthOfShadowIsTheSkysShareOfTheLight) {
  SceneState scene = from_above(180.0, 40.0);
  scene.instances.push_back(place(make_box({1.0, 1.0, 0.1}), {0.0, -1.0, 1.0}, false));
  const LightPictures pictures = rig().render(scene);
  const double sky = 4000.0 * M_PI;
  const double sun = 90000.0 * std::sin(glm::radians(40.0));
  const int y = static_cast<int>(400 - (-1.0 + 1.0 / std::tan(glm::radians(40.0))) / 0.005);
  EXPECT_NEAR(pictures.multiplier.at(400, y).r, sky / (sky + sun), 2.0 / 1023.0);  // 10 bits
}

TEST(SunShadowPicture, RealWallShadesVirtualThingsAndVirtualShadeAddsNothingThere) {
  SceneState scene = from_above(180.0, 30.0);
  scene.instances.push_back(place(make_box({3.0, 0.05, 1.0}), {0.0, -1.0, 0.5}, true));
  scene.instances.push_back(place(make_box({0.1, 0.1, 0.1}), {0.0, -0.5, 0.05}, false));
  const LightPictures pictures = rig().render(scene);
  // The small box stands in the wall's shadow: its top gets sky light only, and the ground beside it is untouched.
  const float top = pictures.added.at(400, 500).r;
  EXPECT_GT(top, 0.0F);
  EXPECT_LT(top, 4000.0F / 30000.0F * 1.05F);
  EXPECT_NEAR(pictures.multiplier.at(400, 480).r, 1.0F, 0.002F);
}

// Pixels between a tenth and nine tenths of the sun along a line across both of the shadow's long edges.
int penumbra_px(double height_m) {
  constexpr double kElevationDeg = 60.0;
  SceneState scene = from_above(180.0, kElevationDeg);
  ensure_sun(scene).angular_radius_rad = 0.02;  // wider than the sun's, to have pixels to count
  const double north = height_m / std::tan(glm::radians(kElevationDeg));
  scene.instances.push_back(place(make_box({1.0, 1.0, 0.001}), {0.0, -north, height_m}, false));
  const glm::dvec3 aside(0.0, 0.6, 0.0);  // the board's own picture must not cover the middle row
  scene.camera =
      look_at(800, 800, glm::dvec3(0.0, 0.0, 40.0) + aside, aside, 2.0 * glm::degrees(std::atan(0.05)), kNorth);
  const LightPictures pictures = rig().render(scene);
  const double sky_share = 4000.0 * M_PI / (4000.0 * M_PI + 90000.0 * std::sin(glm::radians(kElevationDeg)));
  int count = 0;
  for (int x = 0; x < 800; ++x) {
    const double lit = (pictures.multiplier.at(x, 460).r - sky_share) / (1.0 - sky_share);  // 0.3 m north
    count += lit > 0.1 && lit < 0.9 ? 1 : 0;
  }
  return count;
}

TEST(SunShadowPicture, DiscOfTheSunWidensThePenumbraWithDistance) {
  // Across the light the penumbra is 2 * 0.02 * h / sin(60 deg) wide; the middle 80 % of a disc's light take 0.69 of
  // its width. Two edges, 200 pixels a metre; one pixel each way for each of the four ends.
  EXPECT_NEAR(penumbra_px(1.0), 2 * 0.69 * 0.04 * 1.0 / 0.866 * 200.0, 4.0);
  EXPECT_NEAR(penumbra_px(3.0), 2 * 0.69 * 0.04 * 3.0 / 0.866 * 200.0, 4.0);
}

TEST(SunShadowPicture, StillSceneIsBitEqualAndItsShadowMapIsNotRenderedAgain) {
  SceneState scene = from_above(140.0, 40.0);
  scene.instances.push_back(load("plant", {0.0, 0.0, 0.0}));
  const LightPictures first = rig().render(scene);
  const LightPictures second = rig().render(scene);
  EXPECT_TRUE(first.shadow_was_rendered);
  EXPECT_FALSE(second.shadow_was_rendered);
  EXPECT_TRUE(first.added == second.added);
  EXPECT_TRUE(first.multiplier == second.multiplier);
}

TEST(SunShadowPicture, OriginTenKilometresAwayChangesNothingToBeSeen) {
  SceneState near_scene = sunny(140.0, 35.0);
  ensure_sun(near_scene).angular_radius_rad = 0.00465;
  near_scene.camera = look_at(640, 360, {0.0, -4.0, 1.6}, {0.0, 0.0, 0.8}, 50.0);
  near_scene.instances = {ground(), load("bench", {0.0, 0.0, 0.0})};
  near_scene.medium = Medium{};
  near_scene.medium->extinction_per_m = 0.05;
  SceneState far_scene = near_scene;
  const glm::dvec3 away(10000.0, -7000.0, 120.0);
  far_scene.camera.world_from_camera[3] += glm::dvec4(away, 0.0);
  for (Instance& instance : far_scene.instances) instance.world_from_model[3] += glm::dvec4(away, 0.0);
  const LightPictures a = rig().render(near_scene);
  const LightPictures b = rig().render(far_scene);
  dump(a, "bench");
  int differing = 0;
  for (std::size_t i = 0; i < a.added.rgba.size(); ++i) {
    const glm::vec4 difference =
        glm::abs(a.added.rgba[i] - b.added.rgba[i]) + glm::abs(a.multiplier.rgba[i] - b.multiplier.rgba[i]);
    if (difference.x + difference.y + difference.z > 0.01F) ++differing;
  }
  // Rounding in double may move a shadow's edge across a few samples, no more.
  EXPECT_LT(differing, 20);
}

// One kind's map takes the other's place among the layers.
TEST(SunShadowPicture, KindsOfOccludersMayTakeTurns) {
  const auto seen_past = [](std::vector<Instance> instances) {
    SceneState scene = from_above(90.0, 45.0);
    scene.instances = std::move(instances);
    return rig().render(scene);
  };
  const Instance box = place(make_box({0.4F, 0.4F, 0.8F}), {0.0, 0.0, 0.4}, false);
  Instance real_box = box;
  real_box.real = true;
  // A virtual board beneath, for a real thing's shadow to fall on.
  const Instance board = place(make_box({3.0F, 3.0F, 0.02F}), {0.0, 0.0, 0.0}, false);
  const LightPictures virtual_first = seen_past({ground(), box});
  const LightPictures real_first = seen_past({real_box, board});
  const LightPictures both = seen_past({ground(), box, real_box, board});
  const LightPictures virtual_again = seen_past({ground(), box});
  const LightPictures real_again = seen_past({real_box, board});
  EXPECT_TRUE(virtual_first.multiplier == virtual_again.multiplier);
  EXPECT_TRUE(real_first.added == real_again.added);
  EXPECT_TRUE(shadowed(virtual_first, 400 - 80, 400)) << "west of the box, the sun in the east";
  EXPECT_LT(real_first.added.at(400 - 80, 400).r, 0.5F * real_first.added.at(400 + 100, 400).r);
  EXPECT_GT(both.added.at(400, 400).r, 0.0F);
}

}  // namespace
}  // namespace render::test
