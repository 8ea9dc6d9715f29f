// Whatever is listed as a sky model or a cloud preset is a sky: a new one is tested by being listed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "render/sky/clouds.h"
#include "render/sky/sky_models.h"

namespace render {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kDegree = std::numbers::pi / 180.0;

SunPosition sun_at(double elevation_deg) {
  SunPosition sun;
  sun.azimuth_rad = 200.0 * kDegree;
  sun.elevation_rad = sun.apparent_elevation_rad = elevation_deg * kDegree;
  return sun;
}

std::vector<glm::dvec3> directions() {
  std::vector<glm::dvec3> all;
  for (const double elevation_deg : {-30.0, 0.0, 5.0, 40.0, 90.0}) {
    for (const double azimuth_deg : {0.0, 110.0, 200.0}) {
      const double horizontal = std::cos(elevation_deg * kDegree);
      all.emplace_back(horizontal * std::sin(azimuth_deg * kDegree), horizontal * std::cos(azimuth_deg * kDegree),
                       std::sin(elevation_deg * kDegree));
    }
  }
  return all;
}

void expect_light(const SkyModel& sky, const std::string& name) {
  for (const glm::dvec3& direction : directions()) {
    const glm::dvec3 rgb = sky.luminance_rgb(direction);
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(std::isfinite(rgb[i])) << name << ", channel " << i << ", direction z " << direction.z;
      EXPECT_GE(rgb[i], 0.0) << name << ", channel " << i << ", direction z " << direction.z;
    }
    EXPECT_GE(sky.transmittance(direction), 0.0) << name;
    EXPECT_LE(sky.transmittance(direction), 1.0) << name;
  }
}

TEST(SkyModels, EveryListedWordMakesASkyFromNoonToNight) {
  for (const SkyModelInfo& model : sky_models()) {
    for (const std::string& word : model.words) {
      for (const double elevation_deg : {60.0, 3.0, -3.0, -25.0}) {
        SCOPED_TRACE(word + " at " + std::to_string(elevation_deg));
        expect_light(*make_sky({.model = word}, sun_at(elevation_deg)), word);
      }
    }
  }
}

TEST(SkyModels, EveryWordNamesOneModelAndNoOther) {
  std::set<std::string> seen;
  for (const SkyModelInfo& model : sky_models()) {
    EXPECT_FALSE(model.summary.empty()) << model.written;
    EXPECT_TRUE(!model.words.empty() || !model.prefix.empty()) << model.written;
    for (const std::string& word : model.words) {
      EXPECT_TRUE(seen.insert(word).second) << word << " is listed twice";
      EXPECT_EQ(find_sky_model(word), &model) << word;
      const auto names = [&](const SkyModelInfo& other) { return other.is_named_by(word); };
      EXPECT_EQ(std::count_if(sky_models().begin(), sky_models().end(), names), 1) << word;
    }
  }
  EXPECT_EQ(find_sky_model("perezz"), nullptr);
  EXPECT_EQ(find_sky_model(SkyOptions{}.model)->written, SkyOptions{}.model) << "the default is a listed model";
}

TEST(SkyModels, TurbidityOutsideAModelsLimitsIsSaidAndInsideIsNot) {
  for (const SkyModelInfo& model : sky_models()) {
    if (!model.turbidity) continue;
    const std::string word = model.words.empty() ? model.prefix + "x" : model.words.front();
    const auto said = [&](double turbidity) {
      return beyond_range({.model = word, .turbidity = turbidity}, sun_at(30.0));
    };
    EXPECT_THAT(said(model.turbidity->least), IsEmpty()) << word;
    EXPECT_THAT(said(model.turbidity->most), IsEmpty()) << word;
    EXPECT_THAT(said(model.turbidity->least - 0.1), SizeIs(1)) << word;
    EXPECT_THAT(said(model.turbidity->most + 0.1), SizeIs(1)) << word;
  }
}

TEST(SkyModels, AnUnknownWordIsAnsweredWithAllThatMayBeWritten) {
  try {
    make_sky({.model = "green"}, sun_at(10.0));
    FAIL() << "an unknown model was accepted";
  } catch (const std::runtime_error& error) {
    for (const SkyModelInfo& model : sky_models()) EXPECT_THAT(error.what(), HasSubstr(model.written));
  }
}

TEST(CloudPresets, EveryListedPresetIsASkyByDayAndNight) {
  std::set<std::string> seen;
  for (const CloudPreset& preset : cloud_presets()) {
    EXPECT_TRUE(seen.insert(preset.name).second) << preset.name << " is listed twice";
    EXPECT_FALSE(preset.summary.empty()) << preset.name;
    for (const double elevation_deg : {40.0, -2.0, -25.0}) {
      SkyOptions options;
      options.clouds.preset = preset.name;
      expect_light(*make_sky(options, sun_at(elevation_deg)), preset.name);
    }
  }
  EXPECT_TRUE(seen.contains(CloudOptions{}.preset)) << "the default is a listed preset";
}

TEST(CloudPresets, OnlyOnesWithLayersHideAnything) {
  for (const CloudPreset& preset : cloud_presets()) {
    SkyOptions options;
    options.clouds.preset = preset.name;
    const auto sky = make_sky(options, sun_at(40.0));
    double least = 1.0;
    for (int i = 0; i < 400; ++i) {
      const double azimuth = 0.9 * i;
      const double z = 0.2 + 0.8 * (i % 20) / 20.0;
      const double horizontal = std::sqrt(1.0 - z * z);
      least = std::min(least, sky->transmittance({horizontal * std::sin(azimuth), horizontal * std::cos(azimuth), z}));
    }
    if (preset.layers.empty()) {
      EXPECT_EQ(least, 1.0) << preset.name;
    } else {
      EXPECT_LT(least, 0.9) << preset.name;
    }
  }
}

TEST(CloudPresets, AnUnknownNameIsAnsweredWithAllThereAre) {
  SkyOptions options;
  options.clouds.preset = "hail";
  try {
    make_sky(options, sun_at(10.0));
    FAIL() << "an unknown preset was accepted";
  } catch (const std::runtime_error& error) {
    for (const CloudPreset& preset : cloud_presets()) EXPECT_THAT(error.what(), HasSubstr(preset.name));
  }
}

}  // namespace
}  // namespace render
