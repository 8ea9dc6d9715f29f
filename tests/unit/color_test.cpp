// Colour tags: what they mean, and what is assumed where they are silent.

#include "ar/capture/color/color.h"

#include <gtest/gtest.h>

namespace ar {
namespace {

ColorInfo guess(int width, int height) {
  return guess_color({}, width, height);
}

TEST(GuessColor, HighDefinitionIsBt709) {
  for (const auto& [width, height] : {std::pair{1280, 720}, {1920, 1080}, {1080, 1920}, {1024, 768}, {3840, 2160}}) {
    const ColorInfo color = guess(width, height);
    EXPECT_EQ(color.matrix, ColorMatrix::Bt709) << width << "x" << height;
    EXPECT_EQ(color.primaries, Primaries::Bt709);
    EXPECT_EQ(color.transfer, Transfer::Bt709);
    EXPECT_EQ(color.range, ColorRange::Limited);
    EXPECT_EQ(color.siting, ChromaSiting::Left);
  }
}

TEST(GuessColor, StandardDefinitionIsBt601WithThePrimariesOfItsLines) {
  EXPECT_EQ(guess(720, 576).matrix, ColorMatrix::Bt601);
  EXPECT_EQ(guess(720, 576).primaries, Primaries::Bt601_625);
  EXPECT_EQ(guess(720, 480).primaries, Primaries::Bt601_525);
  EXPECT_EQ(guess(720, 486).primaries, Primaries::Bt601_525);
  EXPECT_EQ(guess(320, 240).matrix, ColorMatrix::Bt601);
  EXPECT_EQ(guess(320, 240).primaries, Primaries::Bt709);
}

TEST(GuessColor, TurningThePictureChangesNothing) {
  for (const auto& [width, height] : {std::pair{640, 480}, {720, 576}, {1280, 720}, {480, 270}}) {
    EXPECT_EQ(guess(width, height), guess(height, width)) << width << "x" << height;
  }
}

TEST(GuessColor, LeavesEveryKnownTagAlone) {
  const ColorInfo known{ColorMatrix::Bt601, ColorRange::Full, Transfer::Gamma28, Primaries::DisplayP3,
                        ChromaSiting::TopLeft};
  EXPECT_EQ(guess_color(known, 1920, 1080), known);
  EXPECT_EQ(describe_guess(known, guess_color(known, 1920, 1080)), "");
}

TEST(GuessColor, LeavesNothingUnknown) {
  for (const ColorMatrix matrix : {ColorMatrix::Unknown, ColorMatrix::Rgb, ColorMatrix::Bt601, ColorMatrix::Bt2020}) {
    for (const ColorRange range : {ColorRange::Unknown, ColorRange::Full}) {
      const ColorInfo color = guess_color({matrix, range, {}, {}, {}}, 640, 480);
      EXPECT_NE(color.matrix, ColorMatrix::Unknown);
      EXPECT_NE(color.range, ColorRange::Unknown);
      EXPECT_NE(color.transfer, Transfer::Unknown);
      EXPECT_NE(color.primaries, Primaries::Unknown);
      EXPECT_NE(color.siting, ChromaSiting::Unknown);
    }
  }
}

TEST(GuessColor, WideGamutPrimariesAndMatrixImplyEachOther) {
  EXPECT_EQ(guess_color({ColorMatrix::Bt2020, {}, {}, {}, {}}, 3840, 2160).primaries, Primaries::Bt2020);
  EXPECT_EQ(guess_color({{}, {}, {}, Primaries::Bt2020, {}}, 3840, 2160).matrix, ColorMatrix::Bt2020);
}

TEST(GuessColor, RgbIsFullRangeSrgb) {
  const ColorInfo color = guess_color({ColorMatrix::Rgb, {}, {}, {}, {}}, 640, 480);
  EXPECT_EQ(color.range, ColorRange::Full);
  EXPECT_EQ(color.transfer, Transfer::Srgb);
  EXPECT_EQ(color.primaries, Primaries::Bt709);
}

TEST(GuessColor, FullRangeBt601WithNothingElseSaidIsJpeg) {
  const ColorInfo jpeg = guess_color({ColorMatrix::Bt601, ColorRange::Full, {}, {}, {}}, 4032, 3024);
  EXPECT_EQ(jpeg.transfer, Transfer::Srgb);
  EXPECT_EQ(jpeg.primaries, Primaries::Bt709);
  EXPECT_EQ(jpeg.siting, ChromaSiting::Center);
}

TEST(GuessColor, NamesWhatWasGuessed) {
  const ColorInfo tagged{ColorMatrix::Bt709, ColorRange::Unknown, Transfer::Bt709, Primaries::Unknown, {}};
  EXPECT_EQ(describe_guess(tagged, guess_color(tagged, 1280, 720)), "range limited, primaries BT.709");
}

TEST(ColorTags, EveryColourSurvivesItsTags) {
  for (int matrix = 0; matrix <= static_cast<int>(ColorMatrix::Bt2020); ++matrix) {
    for (int transfer = 0; transfer <= static_cast<int>(Transfer::Hlg); ++transfer) {
      for (int primaries = 0; primaries <= static_cast<int>(Primaries::DisplayP3); ++primaries) {
        const ColorInfo color{static_cast<ColorMatrix>(matrix), ColorRange::Full, static_cast<Transfer>(transfer),
                              static_cast<Primaries>(primaries), ChromaSiting::TopLeft};
        EXPECT_EQ(color_from_tags(tags_from_color(color)), color) << matrix << ' ' << transfer << ' ' << primaries;
      }
    }
  }
}

// Code points of ITU-T H.273 (2021), tables 2 to 4.
TEST(ColorTags, ReadTheStandardsCodePoints) {
  EXPECT_EQ(color_from_tags({1, 1, 1, 1, 1}), (ColorInfo{ColorMatrix::Bt709, ColorRange::Limited, Transfer::Bt709,
                                                         Primaries::Bt709, ChromaSiting::Left}));
  EXPECT_EQ(color_from_tags({5, 6, 5, 2, 2}), (ColorInfo{ColorMatrix::Bt601, ColorRange::Full, Transfer::Bt709,
                                                         Primaries::Bt601_625, ChromaSiting::Center}));
  EXPECT_EQ(color_from_tags({9, 16, 9, 1, 3}), (ColorInfo{ColorMatrix::Bt2020, ColorRange::Limited, Transfer::Pq,
                                                          Primaries::Bt2020, ChromaSiting::TopLeft}));
  EXPECT_EQ(color_from_tags({2, 18, 2, 0, 0}).transfer, Transfer::Hlg);
  EXPECT_EQ(color_from_tags({2, 2, 2, 0, 0}), ColorInfo{});
}

}  // namespace
}  // namespace ar
