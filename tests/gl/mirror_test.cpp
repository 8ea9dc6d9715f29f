#include <gtest/gtest.h>

#include <cmath>

#include "render/sky/sky_light.h"
#include "render/sky/sky_model.h"
#include "tests/testing/light_rig.h"

namespace render::test {
namespace {

constexpr double kAlbedo = 0.2;

SceneState under_perez_sky() {
  SceneState scene = sunny(135.0, 32.0);
  SunPosition sun;
  sun.azimuth_rad = glm::radians(135.0);
  sun.elevation_rad = sun.apparent_elevation_rad = glm::radians(32.0);
  ensure_sun(scene).illuminance_rgb = glm::dvec3(0.0);  // its highlight is not what is looked at
  scene.sky = make_sky({}, sun);
  scene.sky_light = sky_light(*scene.sky, glm::dvec3(0.0), kAlbedo);
  return scene;
}

Instance metal_plate(double roughness) {
  Model model = make_box({4.0, 4.0, 0.1});
  for (Material& material : model.materials) {
    material.base_color = glm::vec4(1.0F);
    material.metallic = 1.0F;
    material.roughness = static_cast<float>(roughness);
  }
  return place(std::move(model), {0.0, 0.0, -0.05}, false);
}

// What the plate's middle shows, cd/m2, seen from that azimuth at that angle above it.
glm::dvec3 mirrored(SceneState scene, double roughness, double azimuth_deg, double elevation_deg) {
  scene.camera = look_at(65, 65, 6.0 * sun_direction(azimuth_deg, elevation_deg), glm::dvec3(0.0), 5.0);
  scene.instances = {metal_plate(roughness)};
  return glm::dvec3(glm::vec3(rig().render(scene).added.at(32, 32))) / scene.exposure;
}

TEST(SkyMirror, SmoothMetalShowsTheSkyThatItFaces) {
  const SceneState scene = under_perez_sky();
  for (const double azimuth : {10.0, 80.0, 200.0, 290.0}) {
    for (const double elevation : {25.0, 50.0, 75.0}) {
      const glm::dvec3 seen = mirrored(scene, 0.0, azimuth, elevation);
      const glm::dvec3 sky = scene.sky->luminance_rgb(sun_direction(azimuth + 180.0, elevation));
      // The environment's BRDF is fitted to a few per cent; a texel of the cube is 5.6 degrees.
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(seen[c] / sky[c], 1.0, 0.06) << "azimuth " << azimuth << ", elevation " << elevation;
      }
    }
  }
}

TEST(SkyMirror, RoughnessBlursTowardsTheMeanOfTheSky) {
  const SceneState scene = under_perez_sky();
  const auto contrast = [&](double roughness) {
    return mirrored(scene, roughness, 315.0, 32.0).g / mirrored(scene, roughness, 135.0, 32.0).g;  // at and off the sun
  };
  const double sharp = contrast(0.1);
  const double satin = contrast(0.5);
  const double dull = contrast(1.0);
  EXPECT_GT(sharp, 1.2 * satin);
  EXPECT_GT(satin, 1.2 * dull);
  EXPECT_GT(dull, 1.0);
}

TEST(SkyMirror, ASkyThatChangesIsMirroredAtOnceAndNoSkyIsBlack) {
  SceneState scene = under_perez_sky();
  const double clear = mirrored(scene, 0.1, 200.0, 50.0).g;
  scene.sky = nullptr;
  scene.sky_light = {};
  EXPECT_EQ(mirrored(scene, 0.1, 200.0, 50.0).g, 0.0);
  scene = under_perez_sky();
  EXPECT_EQ(mirrored(scene, 0.1, 200.0, 50.0).g, clear);
}

}  // namespace
}  // namespace render::test
