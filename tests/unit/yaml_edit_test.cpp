// Values of a YAML text change; nothing else does.

#include "app/scene_file/yaml_edit.h"

#include <gtest/gtest.h>

namespace {

using app::with_yaml_value;

constexpr const char* kScene =
    "# Süßer Garten: comments stay, in any letters\n"
    "skyshaft: 1\n"
    "time: 2024-06-21T07:30:00Z   # solstice\n"
    "sky: { model: perez, turbidity: 3.0 } # clear, mostly\n"
    "medium:\n"
    "  # smoke\n"
    "  visibility: 30\n"
    "  g: \"0.7\" # forward\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(YamlEdit, ChangesOneScalarAndNothingElse) {
  EXPECT_EQ(with_yaml_value(kScene, {"sky", "turbidity"}, "4.5"), replaced(kScene, "3.0", "4.5"));
  EXPECT_EQ(with_yaml_value(kScene, {"time"}, "2024-12-21T08:00:00Z"),
            replaced(kScene, "2024-06-21T07:30:00Z", "2024-12-21T08:00:00Z"));
  EXPECT_EQ(with_yaml_value(kScene, {"medium", "visibility"}, "12"), replaced(kScene, "30\n", "12\n"));
  EXPECT_EQ(with_yaml_value(kScene, {"medium", "g"}, "0.2"), replaced(kScene, "\"0.7\"", "0.2"));
}

TEST(YamlEdit, AddsKeysThatAreMissing) {
  EXPECT_EQ(with_yaml_value(kScene, {"sky", "clouds", "preset"}, "light"),
            replaced(kScene, "{ model", "{ clouds: { preset: light }, model"));
  EXPECT_EQ(with_yaml_value(kScene, {"medium", "albedo"}, "0.9"),
            replaced(kScene, "  visibility: 30", "  albedo: 0.9\n  visibility: 30"));
  EXPECT_EQ(with_yaml_value(kScene, {"quality", "target_ms"}, "20"),
            std::string(kScene) + "quality: { target_ms: 20 }\n");
  EXPECT_EQ(with_yaml_value("sky: {}\n", {"sky", "turbidity"}, "2"), "sky: { turbidity: 2 }\n");
}

TEST(YamlEdit, SpellsOutAScalarThatStandsForAMap) {
  EXPECT_EQ(with_yaml_value("sky: perez # plain\n", {"sky", "turbidity"}, "2"),
            "sky: { model: perez, turbidity: 2 } # plain\n");
}

TEST(YamlEdit, RefusesWhatItCannotDo) {
  EXPECT_THROW(with_yaml_value("sky: [1, 2]\n", {"sky", "turbidity"}, "2"), std::runtime_error);
  EXPECT_THROW(with_yaml_value("sky: { a: 1 }\n", {"sky"}, "2"), std::runtime_error);
  EXPECT_THROW(with_yaml_value("sky: { a: 1\n", {"sky", "a"}, "2"), std::runtime_error);
  EXPECT_THROW(with_yaml_value("- 1\n", {"sky"}, "2"), std::runtime_error);
}

}  // namespace
