#include "render/compare/image_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/compare/flip.h"

namespace render {
namespace {

Image plain(int width, int height, const glm::ivec3& rgb) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) {
    for (int c = 0; c < 3; ++c) image.rgba.push_back(static_cast<std::uint8_t>(rgb[c]));
    image.rgba.push_back(255);
  }
  return image;
}

Image noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image image = plain(width, height, {0, 0, 0});
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (i % 4 != 3) image.rgba[i] = static_cast<std::uint8_t>(random() & 255U);
  }
  return image;
}

double mean(const Plane& plane) {
  double sum = 0.0;
  for (const double v : plane.values) sum += v;
  return sum / static_cast<double>(plane.values.size());
}

TEST(DisplayError, OfEqualPicturesIsNone) {
  const Image image = noise(40, 30, 1);
  const DisplayError error = display_error(image, image);
  EXPECT_TRUE(std::isinf(error.psnr_db));
  EXPECT_DOUBLE_EQ(error.ssim, 1.0);
  EXPECT_EQ(error.flip, 0.0);
  EXPECT_EQ(error.share_off, 0.0);
  EXPECT_TRUE(error.lossless());
}

TEST(DisplayError, PsnrOfOneCodeIs48Decibels) {
  const DisplayError error = display_error(plain(20, 20, {101, 101, 101}), plain(20, 20, {100, 100, 100}));
  EXPECT_NEAR(error.psnr_db, 20.0 * std::log10(255.0), 1e-9);
  EXPECT_EQ(error.share_off, 0.0);
  EXPECT_FALSE(error.lossless());
}

TEST(DisplayError, SsimOfPlainPicturesIsTheirMeansTerm) {
  // Wang et al. 2004, eq. 13 with both variances 0.
  const double c1 = 6.5025;
  const DisplayError error = display_error(plain(20, 20, {60, 60, 60}), plain(20, 20, {120, 120, 120}));
  EXPECT_NEAR(error.ssim, (2.0 * 60.0 * 120.0 + c1) / (60.0 * 60.0 + 120.0 * 120.0 + c1), 1e-9);
}

TEST(DisplayError, SsimOfUnrelatedNoiseIsNearZero) {
  EXPECT_LT(std::abs(display_error(noise(80, 60, 1), noise(80, 60, 2)).ssim), 0.05);
}

TEST(DisplayError, CountsPixelsOffAndLooksAtEdges) {
  const Image truth = plain(20, 10, {100, 100, 100});
  Image test = truth;
  test.rgba[4 * (5 * 20 + 3)] = 103;   // far from the edge
  test.rgba[4 * (5 * 20 + 11)] = 102;  // off by two codes: counted at the edge only
  std::vector<float> distance(200, 5.0F);
  for (std::size_t i = 0; i < 200; ++i) {
    if (i % 20 >= 10) distance[i] = 1e9F;
  }
  const DisplayError error = display_error(test, truth, distance);
  EXPECT_DOUBLE_EQ(error.share_off, 1.0 / 200.0);
  EXPECT_EQ(error.largest_at_edges, 2.0);
  EXPECT_FALSE(display_error(test, truth).largest_at_edges.has_value());
}

TEST(LinearError, IsRelativeToTheTruth) {
  LinearImage truth{2, 1, {glm::vec3(1000.0F), glm::vec3(2000.0F)}};
  LinearImage test{2, 1, {glm::vec3(1010.0F), glm::vec3(2020.0F)}};
  EXPECT_NEAR(linear_error(test, truth).relative_rmse, 0.01, 1e-7);
  EXPECT_NEAR(linear_error(test, truth).largest_relative, 0.01, 1e-7);
  test.rgb[1].g = 0.0F;
  EXPECT_NEAR(linear_error(test, truth).largest_relative, 1.0, 1e-7);
}

// Plain pictures have no features: only the colour difference counts, and the paper gives it in closed form.
TEST(Flip, OfGreenAndBlueIsOneByDefinition) {
  const Plane map = flip(plain(30, 30, {0, 255, 0}), plain(30, 30, {0, 0, 255}));
  EXPECT_NEAR(mean(map), 1.0, 1e-9);
}

TEST(Flip, OfBlackAndWhiteFollowsFromTheirLightness) {
  // HyAB is 100; the largest difference, green to blue in Hunt-adjusted CIELAB, was worked out by hand from
  // L a b = 87.737 -86.185 83.179 and 32.297 79.188 -107.860.
  const double adjust_green = 0.87737;
  const double adjust_blue = 0.32297;
  const double largest = std::pow(
      87.737 - 32.297 +
          std::hypot(-86.185 * adjust_green - 79.188 * adjust_blue, 83.179 * adjust_green + 107.860 * adjust_blue),
      0.7);
  const double low = 0.4 * largest;
  const double expected = 0.95 + 0.05 * (std::pow(100.0, 0.7) - low) / (largest - low);
  EXPECT_NEAR(mean(flip(plain(30, 30, {0, 0, 0}), plain(30, 30, {255, 255, 255}))), expected, 2e-4);
}

TEST(Flip, IsSymmetricAndBounded) {
  const Image a = noise(40, 30, 3);
  const Image b = noise(40, 30, 4);
  const Plane there = flip(a, b);
  const Plane back = flip(b, a);
  for (std::size_t i = 0; i < there.values.size(); ++i) {
    EXPECT_NEAR(there.values[i], back.values[i], 1e-12);
    EXPECT_GE(there.values[i], 0.0);
    EXPECT_LE(there.values[i], 1.0);
  }
}

TEST(Flip, SeesAnEdgeMoreThanAFlatDifference) {
  const Image truth = plain(60, 60, {120, 120, 120});
  Image flat = plain(60, 60, {124, 124, 124});
  Image edge = truth;
  for (std::size_t y = 0; y < 60; ++y) {
    for (std::size_t x = 30; x < 60; ++x) {
      for (std::size_t c = 0; c < 3; ++c) edge.rgba[4 * (y * 60 + x) + c] = 124;
    }
  }
  // On the edge itself the eye's blur leaves half of the colour's difference; the feature makes up for more than that.
  EXPECT_GT(flip(edge, truth).at(30, 30), flip(flat, truth).at(30, 30));
  EXPECT_LT(flip(edge, truth).at(5, 30), 1e-9);
}

TEST(Flip, BlursNoiseThatIsTooFineToSee) {
  const Image truth = plain(60, 60, {128, 128, 128});
  Image checker = truth;
  for (std::size_t i = 0; i < 3600; ++i) {
    const bool odd = (i % 60 + i / 60) % 2 == 1;
    for (std::size_t c = 0; c < 3; ++c) checker.rgba[4 * i + c] = odd ? 132 : 124;
  }
  const Image flat = plain(60, 60, {132, 132, 132});
  EXPECT_LT(mean(flip(checker, truth)), 0.7 * mean(flip(flat, truth)));
}

TEST(DifferenceImage, IsGreyWhereThereIsNone) {
  const Image truth = plain(4, 4, {10, 20, 30});
  Image test = truth;
  test.rgba[0] = 12;
  const Image image = difference_image(test, truth, 16.0);
  EXPECT_EQ(image.rgba[0], 160);
  EXPECT_EQ(image.rgba[1], 128);
  EXPECT_EQ(image.rgba[3], 255);
  EXPECT_THROW(difference_image(test, plain(4, 5, {0, 0, 0})), std::invalid_argument);
}

}  // namespace
}  // namespace render
