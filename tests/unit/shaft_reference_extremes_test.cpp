// The CPU ground truth at the extremes of sun and medium, against a plain sum.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "render/shafts/reference/shaft_reference.h"

namespace render {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;
const glm::dvec3 kLux(90000.0, 80000.0, 70000.0);

glm::dvec3 sun_scale(const SceneState& scene, const ViewRay& ray) {
  return kLux * (scene.medium->albedo * phase(scene.medium->phase_function, scene.medium->g,
                                              glm::dot(ray.direction_in_world, sun_of(scene).direction_in_world)));
}

// A box of 6 x 6 x 4 m that thins out where asked, seen from outside with nothing in the light.
SceneState boxed(double azimuth_deg, double elevation_deg, bool falloff) {
  const double azimuth = azimuth_deg / 180.0 * kPi;
  const double elevation = elevation_deg / 180.0 * kPi;
  SceneState scene;
  ensure_sun(scene) = {.direction_in_world = {std::sin(azimuth) * std::cos(elevation),
                                              std::cos(azimuth) * std::cos(elevation), std::sin(elevation)},
                       .illuminance_rgb = kLux};
  scene.medium = Medium{.extinction_per_m = 0.5, .albedo = 0.95, .g = 0.6};
  scene.medium->extent = Box{{-3.0, -3.0, 0.0}, {3.0, 3.0, 4.0}};
  if (falloff) scene.medium->falloff = HeightFalloff{.base_m = 0.0, .scale_height_m = 2.0};
  return scene;
}

double thinned(const SceneState& scene, double z) {
  const Medium& medium = *scene.medium;
  return medium.extinction_per_m * (medium.falloff ? std::exp(-z / medium.falloff->scale_height_m) : 1.0);
}

// The same by the midpoint rule, with faces that the light is within 1e-12 of running along left out.
double by_midpoints(const SceneState& scene, const ViewRay& ray) {
  const Box& box = *scene.medium->extent;
  const glm::dvec3 sun = sun_of(scene).direction_in_world;
  double from = 0.0;
  double to = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double a = (box.min_in_world[i] - ray.origin_in_world[i]) / ray.direction_in_world[i];
    const double b = (box.max_in_world[i] - ray.origin_in_world[i]) / ray.direction_in_world[i];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  constexpr int kSteps = 20000;
  const double step = (to - from) / kSteps;
  double depth = 0.0;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const glm::dvec3 x = ray.origin_in_world + (from + (k + 0.5) * step) * ray.direction_in_world;
    double way = 1e9;
    for (int i = 0; i < 3; ++i) {
      if (std::abs(sun[i]) < 1e-12) continue;
      way = std::min(way, ((sun[i] > 0.0 ? box.max_in_world[i] : box.min_in_world[i]) - x[i]) / sun[i]);
    }
    double sun_depth = 0.0;
    constexpr int kSunSteps = 64;
    for (int n = 0; n < kSunSteps; ++n) {
      sun_depth += thinned(scene, x.z + way * (n + 0.5) / kSunSteps * sun.z) * way / kSunSteps;
    }
    const double here = thinned(scene, x.z) * step;
    sum += here * std::exp(-depth - 0.5 * here - sun_depth);
    depth += here;
  }
  return sum;
}

TEST(ShaftReference, AgreesWithQuadratureForASunAlongAnAxisAndAHairBesideIt) {
  const ViewRay ray{{5.0, -6.0, 2.0}, glm::normalize(glm::dvec3(-5.2, 6.3, -0.7))};
  for (const bool falloff : {false, true}) {
    for (const double hair_deg : {0.0, 1e-13, 1e-9, 1e-5, 0.01}) {
      for (const auto& [azimuth, elevation] : std::vector<std::pair<double, double>>{
               {0.0, 30.0}, {90.0, 30.0}, {180.0, 45.0}, {270.0, 20.0}, {45.0, 90.0}, {90.0, 0.0}}) {
        const SceneState scene = boxed(azimuth + hair_deg, elevation - hair_deg, falloff);
        const ReferenceLight light = ShaftReference(scene).along(ray, kEndless);
        const glm::dvec3 expected = sun_scale(scene, ray) * by_midpoints(scene, ray);
        // The midpoint rule's own error, mostly where the face changes through which the light comes.
        EXPECT_NEAR(light.luminance_rgb.r / expected.r, 1.0, 2e-4)
            << "azimuth " << azimuth << ", elevation " << elevation << ", hair " << hair_deg << ", falloff " << falloff;
      }
    }
  }
}

TEST(ShaftReference, EndsInAMediumThatThinsOutSteeply) {
  for (const auto& [extinction, scale_height, floor] :
       std::vector<std::tuple<double, double, double>>{{200.0, 3.0, 0.0}, {0.16, 0.03, -1.0}, {1e6, 0.5, 0.0}}) {
    SceneState scene = boxed(146.0, 50.0, true);
    scene.medium->extinction_per_m = extinction;
    scene.medium->falloff->scale_height_m = scale_height;
    scene.medium->extent->min_in_world.z = floor;
    for (const double down : {-0.1, 0.0, 0.2}) {
      const ViewRay ray{{1.2, -8.0, 1.6}, glm::normalize(glm::dvec3(-0.1, 1.0, -down))};
      const ReferenceLight light = ShaftReference(scene).along(ray, kEndless);
      EXPECT_TRUE(std::isfinite(light.luminance_rgb.r));
      EXPECT_GE(light.luminance_rgb.r, 0.0);
      EXPECT_LE(light.error_rgb.r, 1e-6 * kLux.r) << "a stated error";
    }
  }
}

}  // namespace
}  // namespace render
