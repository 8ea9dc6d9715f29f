// Tag maps and their heading from corners without pictures.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "ar/track/lens.h"
#include "calib/tagmap/heading.h"
#include "calib/tagmap/tag_mapper.h"

namespace {

constexpr double kSize = 0.15;

ar::CameraModel camera() {
  ar::CameraModel c = ar::camera_from_horizontal_fov(1280, 960, 1.1);
  c.lens = ar::LensModel::PlumbBob;
  c.distortion = {-0.1, 0.02, 0.0005, -0.0003};
  return c;
}

// Tags on four walls of a room of 5 by 4 m, seen from its middle and round about.
ar::TagMap room() {
  ar::TagMap map;
  for (int i = 0; i < 12; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 12.0;
    const cv::Vec3d at(2.5 * std::sin(angle), 2.5 * std::cos(angle), 0.2 * (i % 3));
    map.tags[i] = {ar::wall_tag(at, angle + std::numbers::pi), kSize};
  }
  return map;
}

// Upright camera at `at` that looks to a heading.
ar::Rigid3 looking(const cv::Vec3d& at, double heading) {
  const cv::Vec3d z(std::sin(heading), std::cos(heading), 0.0);
  const cv::Vec3d y(0.0, 0.0, -1.0);
  const cv::Vec3d x = y.cross(z);
  return {{x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]}, at};
}

calib::TagPicture picture(const ar::TagMap& map, const ar::Rigid3& world_from_camera, double noise_px,
                          std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, noise_px);
  const ar::Lens lens(camera());
  calib::TagPicture out;
  for (const auto& [id, tag] : map.tags) {
    ar::Detection d;
    d.family = map.family;
    d.id = id;
    bool inside = true;
    const auto corners = ar::corners_in_tag(tag.size_m);
    for (std::size_t i = 0; i < 4 && inside; ++i) {
      const auto px = lens.project(world_from_camera.inverse() * (tag.world_from_tag * corners[i]));
      inside = px && px->x > 0.0 && px->y > 0.0 && px->x < 1279.0 && px->y < 959.0;
      if (inside) d.corners_px[i] = *px + cv::Point2d(noise(random), noise(random));
    }
    if (inside) out.detections.push_back(d);
  }
  return out;
}

std::vector<calib::TagPicture> walk(const ar::TagMap& map, double noise_px) {
  std::mt19937 random(4);
  std::vector<calib::TagPicture> pictures;
  for (int i = 0; i < 30; ++i) {
    const double heading = 2.0 * std::numbers::pi * i / 30.0;
    const cv::Vec3d at(0.4 * std::cos(0.9 * i), 0.4 * std::sin(1.7 * i), 0.3 + 0.1 * std::sin(1.0 * i));
    pictures.push_back(picture(map, looking(at, heading), noise_px, random));
  }
  return pictures;
}

// A tag's pose in another tag's frame.
ar::Rigid3 relative(const ar::TagMap& map, int from, int to) {
  return map.tags.at(from).world_from_tag.inverse() * map.tags.at(to).world_from_tag;
}

TEST(TagMapper, ClosesARoundWithinItsOwnUncertainty) {
  const ar::TagMap truth = room();
  calib::MapperOptions options;
  options.tag_size_m = kSize;
  options.origin = 0;
  const calib::MapResult result = calib::map_tags(camera(), "tag36h11", walk(truth, 0.1), options);
  ASSERT_EQ(result.map.tags.size(), 12U);
  EXPECT_TRUE(result.other_groups.empty());
  EXPECT_LT(result.rms_px,
            0.3);  // corners bent by the lens are taken as projected: the noise, 0.14 px, and some of that
  for (const auto& [id, tag] : result.map.tags) {
    if (id == 0) continue;
    const double off = cv::norm(relative(result.map, 0, id).translation - relative(truth, 0, id).translation);
    EXPECT_LT(off, 4.0 * result.notes.at(id).sigma_position_m + 0.01) << "tag " << id;
    EXPECT_GT(result.notes.at(id).sigma_position_m, 0.0);
  }
}

TEST(TagMapper, NamesGroupsThatNoPictureConnects) {
  const ar::TagMap truth = room();
  std::mt19937 random(1);
  std::vector<calib::TagPicture> pictures;
  for (double heading : {0.0, 0.05, 0.1, 3.1, 3.15, 3.2}) {
    pictures.push_back(picture(truth, looking({0.0, 0.0, 0.3}, heading), 0.1, random));
  }
  calib::MapperOptions options;
  options.tag_size_m = kSize;
  options.origin = 0;
  const calib::MapResult result = calib::map_tags(camera(), "tag36h11", pictures, options);
  ASSERT_EQ(result.other_groups.size(), 1U);
  EXPECT_THAT(result.other_groups[0], ::testing::Contains(6));
  EXPECT_TRUE(result.map.tags.contains(0));
  EXPECT_FALSE(result.map.tags.contains(6));
}

TEST(TagMapper, SaysWhichTagsAreSeenWhenTheOriginIsNot) {
  calib::MapperOptions options;
  options.tag_size_m = kSize;
  options.origin = 77;
  try {
    calib::map_tags(camera(), "tag36h11", walk(room(), 0.1), options);
    FAIL() << "no tag 77 is there";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("tag 77 is not in the pictures\nseen: 0, 1, 2"));
  }
}

TEST(Heading, FromAShadowTurnsTheMapToTheSun) {
  // A post at (0, 3), its shadow to (1, 4) in the map; the sun stands at 180 degrees: shadows fall north.
  const ar::Rigid3 map_from_camera = {
      looking({0.0, 0.0, 1.6}, 0.0).rotation * ar::rotation_from_vector({-0.3, 0.0, 0.0}), {0.0, 0.0, 1.6}};
  const ar::Lens lens(camera());
  calib::ShadowClicks clicks;
  clicks.base_px = *lens.project(map_from_camera.inverse() * cv::Vec3d(0.0, 3.0, 0.0));
  clicks.tip_px = *lens.project(map_from_camera.inverse() * cv::Vec3d(1.0, 4.0, 0.0));
  const calib::Heading heading =
      calib::heading_from_shadow(lens, map_from_camera, cv::Matx66d::eye() * 1e-6, clicks, std::numbers::pi);
  // The shadow points to 45 degrees in the map and to 0 in truth.
  EXPECT_NEAR(heading.turn_rad, -std::numbers::pi / 4.0, 1e-6);
  EXPECT_GT(heading.sigma_rad, 1e-3);  // at least the pose's own turn
  EXPECT_LT(heading.sigma_rad, 0.05);
}

TEST(Heading, OfTagsIsThatOfTheirEdgeOrFace) {
  EXPECT_NEAR(calib::heading_of_tag(ar::flat_tag({0, 0, 0}, 0.4)), 0.4, 1e-12);
  EXPECT_NEAR(calib::heading_of_tag(ar::wall_tag({0, 0, 0}, -1.2)), -1.2, 1e-12);
}

}  // namespace
