// shaders/lib compiled as C++: the formulas that the GPU runs, against quadrature, geometry and values of the
// literature.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace shader {
using namespace glm;
#define OUT(type) type&
namespace even {
#include "shaders/lib/medium_path.glsl"
#include "shaders/lib/steps.glsl"
}  // namespace even
namespace boxed {
#define BOUNDED
#include "shaders/lib/medium_path.glsl"
}  // namespace boxed
namespace boxed_and_thinning {
#define FALLOFF
#include "shaders/lib/medium_path.glsl"
#undef BOUNDED
}  // namespace boxed_and_thinning
namespace thinning {
#include "shaders/lib/medium_path.glsl"
#undef FALLOFF
}  // namespace thinning
#include "shaders/lib/brdf.glsl"
#include "shaders/lib/lines.glsl"
#include "shaders/lib/sh9.glsl"
#include "shaders/lib/shadow.glsl"
#undef OUT
}  // namespace shader

namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kExtinction = 0.3F;
constexpr float kScaleHeightM = 3.0F;
const glm::vec3 kLow(-4.0F, 1.0F, -2.0F);
const glm::vec3 kHigh(5.0F, 9.0F, 3.0F);
const glm::vec3 kSun = glm::normalize(glm::vec3(0.3F, -0.5F, 0.8F));
const glm::vec3 kRay = glm::normalize(glm::vec3(0.2F, 1.0F, 0.15F));

double extinction_at(double t, bool thins) {
  return thins ? kExtinction * std::exp(-t * kRay.z / kScaleHeightM) : kExtinction;
}

// Optical depth of the sun's way inside the box to a point of the ray, by quadrature.
double sun_depth(double t, bool thins) {
  const glm::dvec3 point = glm::dvec3(kRay) * t;
  double way = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double face = kSun[axis] > 0.0F ? kHigh[axis] : kLow[axis];
    way = std::min(way, (face - point[axis]) / static_cast<double>(kSun[axis]));
  }
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double z = point.z + way * (i + 0.5) / kSteps * static_cast<double>(kSun.z);
    sum += (thins ? kExtinction * std::exp(-z / kScaleHeightM) : kExtinction) * way / kSteps;
  }
  return sum;
}

// What the segment sends to the eye, by quadrature.
double sunlight(double from, double to, double entry, bool thins, bool bounded) {
  constexpr int kSteps = 4000;
  const double dt = (to - from) / kSteps;
  double depth = 0.0;
  const double before = from - entry;
  for (int i = 0; i < kSteps; ++i) depth += extinction_at(entry + before * (i + 0.5) / kSteps, thins) * before / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = from + (i + 0.5) * dt;
    const double step = extinction_at(t, thins) * dt;
    sum += step * std::exp(-depth - 0.5 * step - (bounded ? sun_depth(t, thins) : 0.0));
    depth += step;
  }
  return sum;
}

template <typename Shape>
Shape shape() {
  return {kExtinction, std::log(kExtinction), kScaleHeightM, kLow, kHigh, kSun};
}

TEST(ShaderLib, SunlightOfASegmentAgreesWithQuadratureInEveryKindOfMedium) {
  // Single precision sums a few exponentials; a bounded medium that thins out is summed in 24 pieces.
  const glm::vec2 segment(3.0F, 7.5F);
  const auto even = shader::even::medium_path(shape<shader::even::MediumShape>(), kRay, 1.5F);
  EXPECT_NEAR(shader::even::sunlight_of(even, segment), sunlight(3.0, 7.5, 1.5, false, false), 1e-5);
  const auto thinning = shader::thinning::medium_path(shape<shader::thinning::MediumShape>(), kRay, 1.5F);
  EXPECT_NEAR(shader::thinning::sunlight_of(thinning, segment), sunlight(3.0, 7.5, 1.5, true, false), 1e-5);
  const auto boxed = shader::boxed::medium_path(shape<shader::boxed::MediumShape>(), kRay, 1.5F);
  EXPECT_NEAR(shader::boxed::sunlight_of(boxed, segment), sunlight(3.0, 7.5, 1.5, false, true), 1e-5);
  using shader::boxed_and_thinning::MediumShape;
  const auto both = shader::boxed_and_thinning::medium_path(shape<MediumShape>(), kRay, 1.5F);
  EXPECT_NEAR(shader::boxed_and_thinning::sunlight_of(both, segment), sunlight(3.0, 7.5, 1.5, true, true), 1e-4);
}

TEST(ShaderLib, DistanceAtAnOpticalDepthIsTheDepthsInverse) {
  const auto even = shader::even::medium_path(shape<shader::even::MediumShape>(), kRay, 1.5F);
  const auto thinning = shader::thinning::medium_path(shape<shader::thinning::MediumShape>(), kRay, 1.5F);
  for (const float t : {1.5F, 1.6F, 4.0F, 20.0F}) {
    EXPECT_NEAR(shader::even::distance_at_optical_depth(even, shader::even::view_depth_to(even, t)), t, 1e-4F * t);
    EXPECT_NEAR(shader::thinning::distance_at_optical_depth(thinning, shader::thinning::view_depth_to(thinning, t)), t,
                1e-3F * t);
  }
}

TEST(ShaderLib, StepsOfEverySpacingTileTheSegment) {
  const auto path = shader::even::medium_path(shape<shader::even::MediumShape>(), kRay, 0.0F);
  const glm::vec2 segment(2.0F, 12.0F);
  constexpr int kSteps = 32;
  constexpr int kNear = 16;
  float last_length = 0.0F;
  for (int i = 0; i < kSteps; ++i) {
    const float equal = shader::even::equal_step(i, kSteps, segment);
    EXPECT_NEAR(equal, 2.0F + 10.0F * static_cast<float>(i) / kSteps, 1e-5F);
    const float begin = shader::even::step_of_equal_depth(i, kSteps, path, segment);
    EXPECT_NEAR(begin, equal, 1e-4F) << "an even medium's optical depth grows evenly";
    const float from = shader::even::growing_step(i, kSteps, kNear, 1.0F, segment);
    const float to = i + 1 < kSteps ? shader::even::growing_step(i + 1, kSteps, kNear, 1.0F, segment) : segment.y;
    EXPECT_GT(to, from);
    EXPECT_GE(to - from, last_length * (1.0F - 1e-3F)) << "steps never become shorter";
    last_length = to - from;
  }
  EXPECT_EQ(shader::even::growing_step(0, kSteps, kNear, 1.0F, segment), segment.x);
}

TEST(ShaderLib, GgxIntegratesToOneOverTheHemisphere) {
  for (const double a : {0.02, 0.1, 0.5, 1.0}) {
    constexpr int kSteps = 20000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = (i + 0.5) / kSteps;
      sum += shader::ggx_distribution(static_cast<float>(cosine), static_cast<float>(a)) * cosine * 2.0 * kPi / kSteps;
    }
    EXPECT_NEAR(sum, 1.0, 0.01) << "alpha " << a;  // the narrowest lobe spans a few of the steps
  }
}

TEST(ShaderLib, ReflectionNeverReturnsMoreThanItGets) {
  for (const float f0 : {0.0F, 0.04F, 0.5F, 1.0F}) {
    for (const float cosine : {1e-3F, 0.2F, 0.7F, 1.0F}) {
      const glm::vec3 fresnel = shader::schlick_fresnel(glm::vec3(f0), cosine);
      EXPECT_GE(fresnel.r, f0);
      EXPECT_LE(fresnel.r, 1.0F);
      for (const float roughness : {0.06F, 0.5F, 1.0F}) {
        const glm::vec3 returned = shader::environment_brdf(glm::vec3(f0), roughness, cosine);
        EXPECT_GE(returned.r, -0.01F);  // the fit goes a little below
        EXPECT_LE(returned.r, 1.01F);   // and above
      }
      // Without shadowing the term is 1 / (4 n_l n_v); with it, never more.
      EXPECT_LE(shader::smith_visibility(cosine, cosine, 0.5F), 0.25F / (cosine * cosine) * 1.001F);
    }
  }
}

TEST(ShaderLib, HarmonicsAreOrthonormal) {
  constexpr int kRows = 64;
  double gram[9][9]{};
  for (int row = 0; row < kRows; ++row) {
    const double z = -1.0 + 2.0 * (row + 0.5) / kRows;
    for (int column = 0; column < 2 * kRows; ++column) {
      const double azimuth = kPi * (column + 0.5) / kRows;
      const double radius = std::sqrt(1.0 - z * z);
      const glm::vec3 direction(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
      double value[9];
      for (int i = 0; i < 9; ++i) {
        glm::vec3 unit[9]{};
        unit[i] = glm::vec3(1.0F);
        value[i] = static_cast<double>(shader::sh9(unit, direction).r);
      }
      for (int i = 0; i < 9; ++i) {
        for (int j = 0; j < 9; ++j) gram[i][j] += value[i] * value[j] * 4.0 * kPi / (2.0 * kRows * kRows);
      }
    }
  }
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) EXPECT_NEAR(gram[i][j], i == j ? 1.0 : 0.0, 2e-3) << i << ", " << j;
  }
}

TEST(ShaderLib, AReceiversSlopeIsThatOfItsPlane) {
  // A map 8 m wide, 4 m high and 10 m deep, axes along the local frame's.
  const glm::mat3 local_from_map(glm::vec3(8, 0, 0), glm::vec3(0, 4, 0), glm::vec3(0, 0, 10));
  const glm::vec3 normal = glm::normalize(glm::vec3(0.3F, -0.2F, -1.0F));  // faces the light, which travels along +z
  const glm::vec2 slope = shader::receiver_slope(local_from_map, normal);
  // On the plane 0.3 x - 0.2 y = z: a map unit of u is 8 m, of depth 10 m.
  EXPECT_NEAR(slope.x, 0.3F * 8.0F / 10.0F, 1e-5F);
  EXPECT_NEAR(slope.y, -0.2F * 4.0F / 10.0F, 1e-5F);
  const glm::vec2 grazing = shader::receiver_slope(local_from_map, glm::vec3(1.0F, 0.0F, 0.0F));
  EXPECT_LE(std::abs(grazing.x), 200.0F);
  EXPECT_TRUE(std::isfinite(grazing.y));
}

TEST(ShaderLib, PenumbrasGrowWithTheGapAndTheSun) {
  shader::ShadowMap map{};
  map.metres_per_unit = glm::vec3(20.0F, 10.0F, 40.0F);
  map.texel = 1.0F / 1024.0F;
  const float sun = std::tan(0.00465F);
  const glm::vec2 radius = shader::penumbra_radius(map, 0.25F, sun);  // a gap of 10 m: 4.65 cm
  EXPECT_NEAR(radius.x * 20.0F, 0.0465F, 1e-4F);
  EXPECT_NEAR(radius.y * 10.0F, 0.0465F, 1e-4F);
  EXPECT_EQ(shader::penumbra_radius(map, 0.25F, 0.0F), glm::vec2(0.0F));
  EXPECT_LT(shader::biased_receiver(map, 0.5F, glm::vec2(3.0F, -2.0F)), 0.5F - 5.0F * map.texel + 1e-6F);
}

TEST(ShaderLib, DirectionsOfTapsSpreadEvenly) {
  glm::vec2 direction(1.0F, 0.0F);
  glm::vec2 sum(0.0F);
  constexpr int kTaps = 89;  // a Fibonacci number
  for (int i = 0; i < kTaps; ++i) {
    EXPECT_NEAR(glm::length(direction), 1.0F, 1e-4F);
    sum += direction;
    direction = shader::next_direction(direction);
  }
  EXPECT_LT(glm::length(sum) / kTaps, 0.02F);
}

// A fan for a picture of 300 x 200 whose sun is there: ends along those borders that face away from it.
shader::LineFan fan(const glm::vec3& sun_in_px) {
  return {sun_in_px, glm::vec2(300.0F, 200.0F), glm::vec4(0.0F, 201.0F, 402.0F, 703.0F), glm::vec2(1.0F), 1003.0F};
}

TEST(ShaderLib, EveryPixelsLineLeadsBackToThePixel) {
  for (const glm::vec3 sun : {glm::vec3(150.0F, 80.0F, 1.0F), glm::vec3(-90.0F, 40.0F, 1.0F),
                              glm::vec3(500.0F, 300.0F, 1.0F), glm::vec3(1.0F, 0.3F, 0.0F)}) {
    const shader::LineFan lines = fan(sun);
    for (const glm::vec2 px : {glm::vec2(10.5F, 20.5F), glm::vec2(250.5F, 190.5F), glm::vec2(149.5F, 5.5F)}) {
      const shader::OnLine on = shader::on_line(lines, px);
      const shader::Line line = shader::line_of_row(lines, on.row);
      const glm::vec2 back = line.end + line.back * on.ahead_px;
      EXPECT_NEAR(back.x, px.x, 0.02F) << "sun " << sun.x << ", " << sun.y << ", " << sun.z;
      EXPECT_NEAR(back.y, px.y, 0.02F);
      EXPECT_NEAR(line.length_px, on.whole_px, 0.05F);
    }
  }
}

}  // namespace
