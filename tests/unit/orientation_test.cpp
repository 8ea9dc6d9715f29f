// The eight ways a stored picture can lie, each turned upright by the filters that Orientation names.

#include "ar/capture/color/orientation.h"

#include <gtest/gtest.h>

#include <array>

#include "ar/capture/color/converter.h"

namespace ar {
namespace {

constexpr std::int32_t kOne = 1 << 16;
constexpr int kWidth = 16;
constexpr int kHeight = 8;

struct Case {
  const char* name;
  int a, b, c, d;  // x' = a x + c y, y' = b x + d y, y down
  int rotation_deg;
};
constexpr Case kCases[] = {
    {"upright", 1, 0, 0, 1, 0},      {"90 clockwise", 0, 1, -1, 0, 90},
    {"180", -1, 0, 0, -1, 180},      {"270 clockwise", 0, -1, 1, 0, 270},
    {"mirrored", -1, 0, 0, 1, 0},    {"upside down mirrored", 1, 0, 0, -1, 180},
    {"transposed", 0, 1, 1, 0, 270}, {"anti-transposed", 0, -1, -1, 0, 90},
};

std::array<std::int32_t, 9> matrix_of(const Case& c) {
  return {c.a * kOne, c.b * kOne, 0, c.c * kOne, c.d * kOne, 0, 0, 0, 1 << 30};
}

ffmpeg::FramePtr numbered_picture() {
  ffmpeg::FramePtr picture = ffmpeg::make_frame();
  picture->format = AV_PIX_FMT_YUV444P;
  picture->width = kWidth;
  picture->height = kHeight;
  EXPECT_EQ(av_frame_get_buffer(picture.get(), 0), 0);
  for (int plane = 0; plane < 3; ++plane) {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        picture->data[plane][y * picture->linesize[plane] + x] = static_cast<std::uint8_t>(16 + y * kWidth + x);
      }
    }
  }
  return picture;
}

TEST(Orientation, FiltersMoveEveryPixelWhereTheMatrixSays) {
  for (const Case& c : kCases) {
    const Orientation orientation = orientation_from_matrix(matrix_of(c).data());
    const int width = orientation.transpose ? kHeight : kWidth;
    const int height = orientation.transpose ? kWidth : kHeight;
    Converter converter({AV_PIX_FMT_YUV444P, width, height, AVCOL_RANGE_MPEG, AVCOL_SPC_BT709, orientation.filters()},
                        1);
    const ffmpeg::FramePtr turned = converter.convert(numbered_picture());
    ASSERT_EQ(turned->width, width) << c.name;
    ASSERT_GT(turned->linesize[0], 0) << c.name << ": rows must run downwards";
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        // The matrix turns about the corner; what comes out negative is shifted back into the picture.
        const int to_x = c.a * x + c.c * y + (c.a + c.c < 0 ? width - 1 : 0);
        const int to_y = c.b * x + c.d * y + (c.b + c.d < 0 ? height - 1 : 0);
        ASSERT_EQ(turned->data[0][to_y * turned->linesize[0] + to_x], 16 + y * kWidth + x)
            << c.name << ", pixel " << x << ' ' << y;
      }
    }
  }
}

TEST(Orientation, TellsTheClockwiseTurn) {
  for (const Case& c : kCases) {
    EXPECT_EQ(orientation_from_matrix(matrix_of(c).data()).rotation_deg(), c.rotation_deg) << c.name;
  }
}

TEST(Orientation, ObliqueAnglesGoToTheNearestQuarterAndSaySo) {
  const std::int32_t tilted[9] = {kOne, kOne / 10, 0, -kOne / 10, kOne, 0, 0, 0, 1 << 30};
  bool exact = true;
  EXPECT_TRUE(orientation_from_matrix(tilted, &exact).upright());
  EXPECT_FALSE(exact);
  orientation_from_matrix(matrix_of(kCases[1]).data(), &exact);
  EXPECT_TRUE(exact);
}

TEST(Orientation, ChromaSitingThatNoTagCanNameBecomesCenter) {
  const Orientation upright;
  const Orientation half_turn{false, true, true};
  const Orientation quarter{true, true, false};
  const Orientation upside_down{false, false, true};
  EXPECT_EQ(siting_after(upright, ChromaSiting::Left), ChromaSiting::Left);
  EXPECT_EQ(siting_after(upside_down, ChromaSiting::Left), ChromaSiting::Left);
  EXPECT_EQ(siting_after(half_turn, ChromaSiting::Left), ChromaSiting::Center);
  EXPECT_EQ(siting_after(quarter, ChromaSiting::Left), ChromaSiting::Center);
  EXPECT_EQ(siting_after(half_turn, ChromaSiting::Center), ChromaSiting::Center);
  EXPECT_EQ(siting_after(upside_down, ChromaSiting::TopLeft), ChromaSiting::Center);
}

}  // namespace
}  // namespace ar
