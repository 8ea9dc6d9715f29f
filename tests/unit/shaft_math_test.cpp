// shaders/lib/medium.glsl compiled as C++: the formulas that the GPU runs, against double-precision truth.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>

#include "render/medium/medium.h"

namespace shader {
using namespace glm;
#define OUT(type) type&
#include "shaders/lib/medium.glsl"
#undef OUT
}  // namespace shader

namespace {

TEST(ShaftMath, PhaseFunctionsAreTheMediumsOwn) {
  const render::PhaseFunction kinds[] = {render::PhaseFunction::HenyeyGreenstein, render::PhaseFunction::CornetteShanks,
                                         render::PhaseFunction::Rayleigh};
  for (int kind = 0; kind < 3; ++kind) {
    for (const float g : {-0.99F, -0.3F, 0.0F, 0.7F, 0.99F}) {
      for (const float c : {-1.0F, -0.2F, 0.5F, 0.999F, 1.0F}) {
        const double truth = render::phase(kinds[kind], static_cast<double>(g), static_cast<double>(c));
        EXPECT_NEAR(shader::phase(kind, g, c), truth, 1e-4 * truth) << kind << " g " << g << " cos " << c;
      }
    }
  }
}

TEST(ShaftMath, ScatteredFractionIsAccurateFromNothingToOpaque) {
  for (const double x : {0.0, 1e-9, 1e-4, 0.049, 0.051, 1.0, 20.0, 1e3}) {
    EXPECT_NEAR(shader::scattered_fraction(static_cast<float>(x)), -std::expm1(-x), 2e-6 * -std::expm1(-x)) << x;
  }
}

TEST(ShaftMath, BoundedFractionAgreesWithQuadrature) {
  const glm::vec3 low(-2.0F, 4.0F, 0.0F);
  const glm::vec3 high(3.0F, 7.0F, 4.0F);
  const glm::vec3 origin(0.0F, 0.0F, 1.5F);
  for (const glm::vec3 sun :
       {glm::vec3(0.2F, -0.7F, 0.6F), glm::vec3(-0.6F, 0.3F, 0.2F), glm::vec3(0.0F, 0.0F, 1.0F)}) {
    for (const float extinction : {1e-4F, 0.3F, 20.0F}) {
      const glm::vec3 s = glm::normalize(sun);
      const glm::vec3 ray = glm::normalize(glm::vec3(0.1F, 1.0F, 0.2F));
      glm::vec3 a;
      glm::vec3 b;
      shader::sun_path_lines(origin, ray, low, high, s, a, b);
      const glm::vec2 segment = shader::box_segment(origin, ray, low, high);
      double sum = 0.0;
      constexpr int kSteps = 20000;
      const double length = segment.y - segment.x;
      for (int i = 0; i < kSteps; ++i) {
        const double t = length * (i + 0.5) / kSteps;
        const double path = shader::sun_path(a, b, static_cast<float>(segment.x + t));
        sum += extinction * std::exp(-extinction * (t + path)) * length / kSteps;
      }
      const float fraction = shader::bounded_fraction(extinction, segment, segment.x, a, b);
      EXPECT_NEAR(fraction, sum, 2e-4 * sum + 1e-9) << "extinction " << extinction << ", sun z " << s.z;
    }
  }
}

}  // namespace
