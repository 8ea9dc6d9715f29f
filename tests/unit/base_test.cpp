#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "render/base/check.h"
#include "render/base/csv.h"
#include "render/base/luminance.h"
#include "render/base/median.h"
#include "render/base/number.h"

namespace {

std::string thrown_by(void failing()) {
  try {
    failing();
  } catch (const std::logic_error& error) {
    return error.what();
  }
  return "";
}

TEST(Check, PrintsBothValuesAndThePlace) {
  const std::string text = thrown_by([] {
    const double low = 1.5;
    CHECK(low <= 0.25);
  });
  EXPECT_NE(text.find("CHECK(low <= 0.25) failed: 1.5 <= 0.25"), std::string::npos) << text;
  EXPECT_NE(text.find("base_test.cpp:"), std::string::npos) << text;
}

TEST(Check, SaysNothingWhereTheConditionHolds) {
  EXPECT_EQ(thrown_by([] {
              CHECK(1 < 2);
              CHECK(2 >= 2);
              CHECK(std::isfinite(1.0));
            }),
            "");
}

TEST(Check, NotANumberIsInNoDomain) {
  EXPECT_NE(thrown_by([] { CHECK(std::nan("") >= 0.0); }), "");
  EXPECT_NE(thrown_by([] { CHECK(std::isfinite(std::nan(""))); }), "");
}

TEST(Median, OfAnEvenCountLiesBetweenOrIsOneOfTheTwo) {
  const std::vector<double> values{4.0, 1.0, 3.0, 2.0};
  EXPECT_DOUBLE_EQ(render::median(values), 2.5);
  EXPECT_DOUBLE_EQ(render::upper_median(values), 3.0);
  EXPECT_DOUBLE_EQ(render::lower_median(values), 2.0);
}

TEST(Median, OfAnOddCountIsTheMiddleOne) {
  const std::vector<double> values{5.0, 1.0, 3.0};
  EXPECT_DOUBLE_EQ(render::median(values), 3.0);
  EXPECT_DOUBLE_EQ(render::upper_median(values), 3.0);
  EXPECT_DOUBLE_EQ(render::lower_median(values), 3.0);
}

TEST(Median, OfNoneIsNotANumberUnlessSaid) {
  EXPECT_TRUE(std::isnan(render::median(std::vector<double>())));
  EXPECT_TRUE(std::isnan(render::upper_median({})));
  EXPECT_TRUE(std::isnan(render::lower_median({})));
  EXPECT_DOUBLE_EQ(render::median(std::vector<double>(), 0.0), 0.0);
}

TEST(Luminance, WhiteIsOne) {
  EXPECT_DOUBLE_EQ(render::rec709_luminance(1.0, 1.0, 1.0), 1.0);
}

TEST(Number, IsReadWhole) {
  EXPECT_EQ(render::parse_number("-12.5"), -12.5);
  EXPECT_EQ(render::parse_number("+1e3"), 1000.0);
  EXPECT_EQ(render::parse_number(".5"), 0.5);
  for (const char* text : {"", "+", "1.5m", "1,5", "nan", "inf", "-inf", "0x10", " 1", "1 ", "+-1", "--1"}) {
    EXPECT_FALSE(render::parse_number(text)) << text;
  }
  EXPECT_FALSE(render::parse_number("1" + std::string(309, '0'))) << "beyond the largest double";
  EXPECT_FALSE(render::parse_unsigned("-1"));
}

TEST(Number, CountsAreDigitsThatFit) {
  EXPECT_EQ(render::parse_count<int>("1280"), 1280);
  for (const char* text : {"", "-1", "+1", "1.0", "1e3", "99999999999"}) {
    EXPECT_FALSE(render::parse_count<int>(text)) << text;
  }
}

using Record = std::vector<std::string>;

TEST(Csv, FieldsInQuotesHoldCommasQuotesAndLineBreaks) {
  std::istringstream in(
      "\xEF\xBB\xBF"
      "a,b\r\n\n1,\"x, \"\"y\"\"\nz\"\n2,\n");
  render::CsvRecords records(in);
  EXPECT_EQ(records.next(), (Record{"a", "b"}));
  EXPECT_EQ(records.next(), (Record{"1", "x, \"y\"\nz"}));
  EXPECT_EQ(records.line(), 3);
  EXPECT_EQ(records.next(), (Record{"2", ""}));
  EXPECT_EQ(records.line(), 5);
  EXPECT_FALSE(records.next());
}

TEST(Csv, AFieldThatIsNeverClosedIsRefused) {
  std::istringstream in("a\n\"b\n");
  render::CsvRecords records(in);
  EXPECT_TRUE(records.next());
  EXPECT_THROW(records.next(), std::runtime_error);
}

}  // namespace
