// How a technique of shafts and its settings are named.
#include "render/shafts/shaft_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using render::parse_shaft_settings;
using testing::HasSubstr;

std::string refusal(const std::string& text) {
  try {
    parse_shaft_settings(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ShaftSettings, EveryPresetReadsAsWhatItIsWrittenFrom) {
  for (const render::ShaftTechniqueInfo& info : render::shaft_techniques()) {
    EXPECT_FALSE(info.presets.empty()) << info.name;
    for (const std::string& rung : info.presets) {
      const render::ShaftSettings settings = parse_shaft_settings(rung);
      EXPECT_EQ(settings.technique, info.name);
      EXPECT_EQ(parse_shaft_settings(to_text(settings)), settings) << rung;
    }
  }
}

TEST(ShaftSettings, WhatIsNotSetIsTheStandardValue) {
  const render::ShaftSettings settings = parse_shaft_settings("march:steps=77");
  EXPECT_EQ(settings.integer("steps"), 77);
  EXPECT_EQ(settings.integer("divisor"), 1);
  EXPECT_THROW(settings.number("radius"), std::logic_error);
}

TEST(ShaftSettings, RefusalsTellWhatIsAccepted) {
  EXPECT_THAT(refusal("marsh"), testing::AllOf(HasSubstr("'marsh'"), HasSubstr("march"), HasSubstr("minmax")));
  EXPECT_THAT(refusal("march:step=3"), testing::AllOf(HasSubstr("step=3"), HasSubstr("spacing=")));
  EXPECT_THAT(refusal("march:steps=0"), HasSubstr("a whole number from 1 to 8192"));
  EXPECT_THAT(refusal("march:steps=1.5"), HasSubstr("'1.5'"));
  EXPECT_THAT(refusal("march:steps="), HasSubstr("''"));
  EXPECT_THAT(refusal("march:spacing=wide"), HasSubstr("distance or depth or growing"));
  EXPECT_THAT(refusal("march:steps=3,steps=4"), HasSubstr("twice"));
  EXPECT_THAT(refusal("auto:steps=3"), HasSubstr("auto takes no settings"));
}

}  // namespace
