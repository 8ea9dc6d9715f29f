#include "render/sky/moon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/sky/sky_image.h"
#include "render/sky/twilight.h"
#include "render/sun/spectrum.h"
#include "tests/testing/table.h"

namespace render {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;

UtcTime utc(const std::string& t) {
  const std::chrono::sys_days date = std::chrono::year{std::stoi(t.substr(0, 4))} /
                                     std::chrono::month{static_cast<unsigned>(std::stoi(t.substr(5, 2)))} /
                                     std::chrono::day{static_cast<unsigned>(std::stoi(t.substr(8, 2)))};
  return date + std::chrono::hours(std::stoi(t.substr(11, 2))) + std::chrono::minutes(std::stoi(t.substr(14, 2))) +
         std::chrono::seconds(std::stoi(t.substr(17, 2)));
}

// edge case 27: without parallax it is up to a degree off
TEST(MoonPosition, AgreesWithTheReferenceTable) {
  const auto rows = read_table(SKYSHAFT_SHARED_DATA "/sky_reference/moon-positions.csv");
  if (rows.empty()) GTEST_SKIP() << "reference table is absent";
  for (const auto& row : rows) {
    const auto number = [&row](const char* name) { return std::stod(row.at(name)); };
    const Place place{number("lat_deg") * kDeg, number("lon_deg") * kDeg, 0.0};
    const MoonPosition moon = moon_position(place, utc(row.at("ut1")));
    SunPosition expected;
    expected.azimuth_rad = number("azimuth_deg") * kDeg;
    expected.elevation_rad = number("elevation_deg") * kDeg;
    const double cosine = glm::dot(expected.direction_in_world(), as_sun(moon).direction_in_world());
    // Leap seconds to come are not known: the table's terrestrial time is up to a minute off, half a minute of arc.
    EXPECT_LT(std::acos(std::min(cosine, 1.0)) / kDeg, 0.02) << row.at("ut1");
    EXPECT_NEAR(moon.illuminated_fraction, number("illuminated_fraction"), 0.002) << row.at("ut1");
    EXPECT_NEAR(moon.phase_angle_rad / kDeg, number("phase_angle_deg"), 0.2) << row.at("ut1");
    const double lux = number("usno171_moon_lux");
    if (number("elevation_deg") > 1.0) {
      EXPECT_NEAR(moon_illuminance_lux(moon.elevation_rad, moon.phase_angle_rad, moon.distance_m), lux,
                  0.05 * lux + 1e-6)
          << row.at("ut1");
    }
  }
}

TEST(ClearIlluminance, MatchesTheObservatorysTable) {
  const auto rows = read_table(SKYSHAFT_SHARED_DATA "/sky_reference/illuminance-by-elevation.csv");
  if (rows.empty()) GTEST_SKIP() << "reference table is absent";
  for (const auto& row : rows) {
    const double expected = std::stod(row.at("sun_total_horizontal_lux_usno171"));
    const double value = clear_illuminance_lux(std::stod(row.at("elevation_deg")) * kDeg);
    EXPECT_NEAR(value / expected, 1.0, 0.03) << row.at("elevation_deg");  // pieces are blended where they meet
  }
}

TEST(SkyImage, SunIsFoundMeasuredAndRemoved) {
  struct Fact {
    const char* file;
    double elevation_deg;
    double share;
    bool unclipped;
  };
  for (const Fact& fact : {Fact{"sky.hdr", 48.0, 0.52, true}, Fact{"sunrise.hdr", 7.9, 0.78, true},
                           Fact{"park.hdr", 10.4, 0.68, true}, Fact{"forest.hdr", 39.9, 0.01, false}}) {
    const std::filesystem::path path = std::filesystem::path(SKYSHAFT_SHARED_DATA) / "sky_hdr" / fact.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no sky pictures";
    const LinearImage picture = read_hdr(path);
    const SkyImage image = separate_sun(picture);
    ASSERT_EQ(image.sun.has_value(), fact.unclipped) << fact.file;
    if (!image.sun) continue;
    EXPECT_NEAR(std::asin(image.sun->direction_in_picture.z) / kDeg, fact.elevation_deg, 1.0) << fact.file;
    double remaining = 0.0;
    float brightest = 0.0F;
    for (int row = 0; row < picture.height; ++row) {
      const double pixel_sr =
          2.0 * std::numbers::pi / picture.width *
          (std::cos(std::numbers::pi * row / picture.height) - std::cos(std::numbers::pi * (row + 1) / picture.height));
      for (int column = 0; column < picture.width; ++column) {
        const glm::vec3& rgb = image.sky.rgb[static_cast<std::size_t>(row * picture.width + column)];
        remaining += luminance(glm::dvec3(rgb)) * pixel_sr;
        brightest = std::max(brightest, rgb.g);
      }
    }
    const double sun = luminance(image.sun->irradiance_rgb);
    EXPECT_NEAR(sun / (sun + remaining), fact.share, 0.06) << fact.file;
    EXPECT_LT(brightest, 1000.0F) << fact.file;  // the discs are 60,000 and more
  }
}

TEST(SkyImage, RefusesAPictureThatIsNotLatLong) {
  EXPECT_THROW(separate_sun(LinearImage{3, 3, std::vector<glm::vec3>(9)}), std::invalid_argument);
}

}  // namespace
}  // namespace render
