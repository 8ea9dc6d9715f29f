// Colour and tone of pictures against the published formulas. Runs the shaders' own functions, compiled as C++.

#include "render/composite/picture_math.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using render::ColorMatrix;
using render::ColorRange;
using render::PictureFormat;
using render::Transfer;

TEST(TransferFunction, Bt709MatchesTheRecommendation) {
  // BT.709-6 item 1.2 prints rounded constants; both forms agree to 3e-4.
  for (double light = 0.0; light <= 1.0; light += 1.0 / 256.0) {
    const double published = light < 0.018 ? 4.5 * light : 1.099 * std::pow(light, 0.45) - 0.099;
    EXPECT_NEAR(render::coded_from_linear(Transfer::Bt709, glm::vec3(static_cast<float>(light))).x, published, 3e-4)
        << light;
  }
}

TEST(TransferFunction, SrgbMatchesTheStandard) {
  for (double light = 0.0; light <= 1.0; light += 1.0 / 256.0) {
    const double published = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
    EXPECT_NEAR(render::coded_from_linear(Transfer::Srgb, glm::vec3(static_cast<float>(light))).x, published, 2e-6)
        << light;
  }
}

TEST(TransferFunction, PowersAreWhatTheirNamesSay) {
  EXPECT_NEAR(render::linear_from_coded(Transfer::Gamma22, glm::vec3(0.5F)).y, std::pow(0.5, 2.2), 1e-6);
  EXPECT_NEAR(render::linear_from_coded(Transfer::Gamma28, glm::vec3(0.5F)).y, std::pow(0.5, 2.8), 1e-6);
  EXPECT_EQ(render::linear_from_coded(Transfer::Linear, glm::vec3(0.5F)).y, 0.5F);
}

TEST(TransferFunction, EncodingUndoesDecodingBeyondBlackAndWhiteToo) {
  for (const Transfer transfer :
       {Transfer::Bt709, Transfer::Srgb, Transfer::Linear, Transfer::Gamma22, Transfer::Gamma28}) {
    for (float coded = -0.2F; coded <= 1.3F; coded += 0.003F) {
      const glm::vec3 back = render::coded_from_linear(transfer, render::linear_from_coded(transfer, glm::vec3(coded)));
      // A hundredth of a 10-bit step; pow in single precision.
      EXPECT_NEAR(back.x, coded, 1e-5) << "transfer " << static_cast<int>(transfer);
    }
  }
}

TEST(TransferFunction, HdrIsRefused) {
  EXPECT_THROW(render::linear_from_coded(Transfer::Pq, glm::vec3(0.5F)), std::runtime_error);
  EXPECT_THROW(render::coded_from_linear(Transfer::Hlg, glm::vec3(0.5F)), std::runtime_error);
}

// Codes of a colour from the recommendations' own equations: E'Y, (E'B - E'Y) / 1.772 and so on.
struct KnownCode {
  PictureFormat format;
  glm::dvec3 rgb;
  glm::ivec3 code;
};

TEST(CodeTransform, ColourBarsHaveTheirPublishedCodes) {
  const PictureFormat sd{.matrix = ColorMatrix::Bt601, .range = ColorRange::Limited};
  const PictureFormat hd{.matrix = ColorMatrix::Bt709, .range = ColorRange::Limited};
  const PictureFormat hd10{.bit_depth = 10, .matrix = ColorMatrix::Bt709, .range = ColorRange::Limited};
  const PictureFormat jpeg{.matrix = ColorMatrix::Bt601, .range = ColorRange::Full};
  // 100 % bars: BT.801 for BT.601, SMPTE RP 219 for BT.709 at 8 and 10 bits; JFIF's full range.
  const KnownCode known[] = {
      {sd, {1, 1, 1}, {235, 128, 128}},   {sd, {1, 0, 0}, {81, 90, 240}},     {sd, {0, 0, 1}, {41, 240, 110}},
      {hd, {1, 0, 0}, {63, 102, 240}},    {hd, {0, 1, 0}, {173, 42, 26}},     {hd, {0, 0, 1}, {32, 240, 118}},
      {hd10, {1, 1, 1}, {940, 512, 512}}, {hd10, {1, 0, 0}, {250, 409, 960}}, {jpeg, {0, 1, 0}, {150, 44, 21}},
  };
  for (const KnownCode& k : known) {
    const render::CodeTransform t = render::code_from_rgb(k.format);
    const glm::dvec3 code = t.matrix * k.rgb + t.offset;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(code[c], k.code[c], 0.51) << "plane " << c;
  }
}

TEST(CodeTransform, RgbPlanesAreGreenBlueRed) {
  const PictureFormat format{.matrix = ColorMatrix::Rgb, .range = ColorRange::Full};
  const render::CodeTransform t = render::code_from_rgb(format);
  const glm::dvec3 code = t.matrix * glm::dvec3(0.2, 0.4, 0.6) + t.offset;
  EXPECT_NEAR(code[0], 0.4 * 255.0, 1e-9);
  EXPECT_NEAR(code[1], 0.6 * 255.0, 1e-9);
  EXPECT_NEAR(code[2], 0.2 * 255.0, 1e-9);
}

TEST(Bt2020FromRec709, WhiteStaysWhite) {
  const glm::dvec3 white = render::bt2020_from_709() * glm::dvec3(1.0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1.0, 2e-4);  // printed with four digits
}

TEST(Shoulder, IsTheIdentityBelowTheKnee) {
  for (float x = -0.5F; x <= 0.75F; x += 0.01F) EXPECT_EQ(render::shoulder(glm::vec3(x)).x, x);
}

TEST(Shoulder, RisesEverywhereWithoutAKink) {
  constexpr float kStep = 1e-3F;
  float slope_before = 1.0F;
  for (float x = 0.0F; x < 4.0F; x += kStep) {
    const float slope = (render::shoulder(glm::vec3(x + kStep)).x - render::shoulder(glm::vec3(x)).x) / kStep;
    EXPECT_GT(slope, 0.05F) << x;
    // Second derivative is at most 2 / 0.375 just past the knee.
    EXPECT_NEAR(slope, slope_before, 0.008F) << x;
    slope_before = slope;
  }
}

TEST(Shoulder, ReachesWhiteAtHalfAStopAboveWhite) {
  EXPECT_NEAR(render::shoulder(glm::vec3(1.5F)).x, 1.0F, 1e-6F);
}

TEST(Shoulder, InverseUndoesIt) {
  for (float x = -0.5F; x <= 5.0F; x += 0.01F) {
    EXPECT_NEAR(render::shoulder_inverse(render::shoulder(glm::vec3(x))).x, x, 2e-5F * std::fmax(1.0F, x));
  }
}

TEST(Dither, StaysBelowHalfAStepAndAveragesToNothing) {
  double sum = 0.0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float d = render::dither(glm::vec2(x, y));
      EXPECT_LE(std::abs(d), 0.5F);
      sum += d;
    }
  }
  EXPECT_NEAR(sum / (64.0 * 64.0), 0.0, 0.01);
}

}  // namespace
