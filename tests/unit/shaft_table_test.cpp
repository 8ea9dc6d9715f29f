#include "render/plan/shaft_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace render {
namespace {

const std::vector<ShaftMeasurement> kTable{{"closed-form", 0.6, 1.0},  // cuts no shafts: never chosen
                                           {"march:steps=16", 0.2, 50.0},
                                           {"march:steps=64", 0.05, 200.0},
                                           {"interleaved", 0.06, 20.0},
                                           {"march:steps=1024", 0.01, 3000.0}};

std::string chosen(const ShaftDemand& demand, double pixels = 1e6) {
  return to_text(choose_shafts(kTable, demand, pixels).value());
}

TEST(ShaftTable, MaxErrorTakesTheCheapestThatHoldsIt) {
  EXPECT_EQ(chosen({.max_error = 0.3, .target_ms = {}}), "interleaved");
  EXPECT_EQ(chosen({.max_error = 0.055, .target_ms = {}}), "march:steps=64");
  EXPECT_EQ(chosen({.max_error = 0.001, .target_ms = {}}), "march:steps=1024");  // none holds it: the most accurate
}

TEST(ShaftTable, TargetTimeTakesTheMostAccurateThatFits) {
  EXPECT_EQ(chosen({.max_error = {}, .target_ms = 250.0}), "march:steps=64");
  EXPECT_EQ(chosen({.max_error = {}, .target_ms = 250.0}, 16e6), "interleaved");  // sixteen times the pixels
  EXPECT_EQ(chosen({.max_error = {}, .target_ms = 1.0}), "interleaved");          // none fits: the cheapest
}

TEST(ShaftTable, BothDemandsTogether) {
  EXPECT_EQ(chosen({.max_error = 0.07, .target_ms = 250.0}), "interleaved");
  EXPECT_EQ(chosen({.max_error = 0.02, .target_ms = 250.0}), "march:steps=64");
  EXPECT_FALSE(choose_shafts(kTable, {}, 1e6).has_value());
}

TEST(ShaftTable, ReadsTheWorstOfAllScenes) {
  const auto table = read_shaft_table(
      "scene,width,height,settings,shafts_ms,relative_rmse\n"
      "gate,1000,1000,\"march:steps=16,divisor=2\",10,0.1\n"
      "room,2000,1000,\"march:steps=16,divisor=2\",30,0.05\n");
  ASSERT_EQ(table.size(), 1U);
  EXPECT_EQ(table[0].settings, "march:steps=16,divisor=2");
  EXPECT_DOUBLE_EQ(table[0].ms_per_megapixel, 15.0);
  EXPECT_DOUBLE_EQ(table[0].relative_rmse, 0.1);
}

TEST(ShaftTable, SaysWhatIsWrongWithATable) {
  EXPECT_THROW(read_shaft_table("scene,width\n"), std::runtime_error);
  EXPECT_THROW(read_shaft_table("width,height,settings,shafts_ms,relative_rmse\n1,1,march\n"), std::runtime_error);
  EXPECT_THROW(read_shaft_table("width,height,settings,shafts_ms,relative_rmse\n1,1,march,x,1\n"), std::runtime_error);
}

TEST(ShaftTable, TheOneThatShipsTradesErrorForTime) {
  ASSERT_GE(shaft_table().size(), 10U);
  const auto loose = choose_shafts(shaft_table(), {.max_error = 0.5, .target_ms = {}}, 1e6);
  const auto tight = choose_shafts(shaft_table(), {.max_error = 0.001, .target_ms = {}}, 1e6);
  EXPECT_NE(to_text(*loose), to_text(*tight));
}

}  // namespace
}  // namespace render
