#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sky/hemisphere.h"
#include "render/sky/sky_light.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kPi = std::numbers::pi;

SunPosition sun_at(double azimuth_deg, double elevation_deg) {
  SunPosition sun;
  sun.azimuth_rad = azimuth_deg * kPi / 180.0;
  sun.elevation_rad = sun.apparent_elevation_rad = elevation_deg * kPi / 180.0;
  return sun;
}

class UniformSky final : public SkyModel {
 public:
  glm::dvec3 luminance_rgb(const glm::dvec3&) const override { return {100.0, 200.0, 300.0}; }
};

TEST(Spectrum, SolarConstantIsLuminousAndNearlyWhite) {
  const glm::dvec3 xyz = xyz_from_spectrum(extraterrestrial_irradiance());
  EXPECT_NEAR(xyz.y, 133100.0, 1.0);
  // published chromaticity of ASTM E490 under the 2 degree observer: 0.3217, 0.3326
  EXPECT_NEAR(xyz.x / (xyz.x + xyz.y + xyz.z), 0.3217, 0.003);
  EXPECT_NEAR(xyz.y / (xyz.x + xyz.y + xyz.z), 0.3326, 0.003);
}

TEST(Spectrum, ColourMatricesInvertAndKeepLuminance) {
  const glm::dvec3 xyz(0.3, 0.5, 0.7);
  EXPECT_NEAR(glm::length(xyz_from_rgb(rgb_from_xyz(xyz)) - xyz), 0.0, 1e-12);
  EXPECT_NEAR(luminance(rgb_from_xyz(xyz)), 0.5, 1e-9);
  EXPECT_NEAR(luminance(clip_to_gamut({-0.2, 0.8, 0.1})), luminance({-0.2, 0.8, 0.1}),
              1e-9);  // ten digits of the primaries
}

TEST(Hemisphere, IntegratesSolidAngleAndCosineExactly) {
  double solid_angle = 0.0;
  double cosine = 0.0;
  for (const SolidAngleSample& sample : upper_hemisphere()) {
    solid_angle += sample.solid_angle_sr;
    cosine += sample.solid_angle_sr * sample.direction_in_world.z;
  }
  EXPECT_NEAR(solid_angle, 2.0 * kPi, 1e-12);
  EXPECT_NEAR(cosine, kPi, 1e-12);
}

TEST(SkyLight, UniformSkyGivesPiTimesItsLuminance) {
  const SkyLight light = sky_light(UniformSky(), glm::dvec3(0.0), 1.0);  // a white ground closes the sphere
  EXPECT_NEAR(light.horizontal_illuminance_rgb.y, 200.0 * kPi, 1e-9);
  for (const glm::dvec3& normal : {glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0.6, -0.8, 0.0)}) {
    EXPECT_NEAR(irradiance(light.radiance_sh, normal).z, 300.0 * kPi, 1e-2);  // six digits of the basis
  }
  EXPECT_NEAR(in_scatter_luminance(light.radiance_sh, PhaseFunction::HenyeyGreenstein, 0.9, {0, 1, 0}).x, 100.0, 1e-3);
}

TEST(SkyLight, GroundReturnsSunAndSky) {
  const glm::dvec3 sun(1000.0);
  const SkyLight light = sky_light(UniformSky(), sun, 0.5);
  const glm::dvec3 down = irradiance(light.radiance_sh, {0, 0, -1});
  EXPECT_NEAR(down.x, 0.5 * (1000.0 + 100.0 * kPi), 0.06 * down.x);  // nine coefficients ring at the horizon
}

TEST(SkyLight, InScatterFollowsThePhaseFunctionOfAFewBands) {
  const auto sky = make_sky({}, sun_at(90.0, 30.0));
  const SkyLight light = sky_light(*sky, glm::dvec3(0.0));
  const glm::dvec3 east(1.0, 0.0, 0.0);
  for (const PhaseFunction function :
       {PhaseFunction::HenyeyGreenstein, PhaseFunction::CornetteShanks, PhaseFunction::Rayleigh}) {
    glm::dvec3 sum(0.0);
    const glm::dvec3 ground = light.horizontal_illuminance_rgb * 0.2 / kPi;
    for (const SolidAngleSample& s : upper_hemisphere()) {
      const glm::dvec3 up = s.direction_in_world;
      const glm::dvec3 down(up.x, up.y, -up.z);
      sum += s.solid_angle_sr * (phase(function, 0.3, glm::dot(up, east)) * sky->luminance_rgb(up) +
                                 phase(function, 0.3, glm::dot(down, east)) * ground);
    }
    const glm::dvec3 closed = in_scatter_luminance(light.radiance_sh, function, 0.3, east);
    EXPECT_NEAR(closed.y / sum.y, 1.0, 0.05);  // bands above 2 of a sky with an aureole
  }
}

TEST(PerezSky, IsBlueAndBrightByDayAndDarkAtNight) {
  const auto noon = make_sky({}, sun_at(180.0, 50.0));
  const glm::dvec3 zenith = noon->luminance_rgb({0, 0, 1});
  EXPECT_GT(luminance(zenith), 1500.0);
  EXPECT_LT(luminance(zenith), 8000.0);
  EXPECT_GT(zenith.b, 1.3 * zenith.r);
  const auto night = make_sky({}, sun_at(0.0, -17.0));
  EXPECT_LT(luminance(night->luminance_rgb({0, 0, 1})), 0.01);
}

TEST(MakeSky, NamesAnUnknownModel) {
  try {
    make_sky({.model = "green"}, sun_at(0.0, 10.0));
    FAIL() << "an unknown model was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("green"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("perez"), std::string::npos);
  }
}

}  // namespace
}  // namespace render
