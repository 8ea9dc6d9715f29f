#pragma once
// Draws an AprilTag of libapriltag as a camera would see it: exact area coverage, a little blur and noise.
// Coordinates here count from the picture's edge: the centre of the first pixel is (0.5, 0.5).
#include <apriltag/apriltag.h>
#include <apriltag/common/image_u8.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

struct DrawnTag {
  double x, y;   // centre, px
  double side;   // outer edge of the black border, px
  double angle;  // rad, clockwise in the picture

  // Top left, top right, bottom right, bottom left of the tag as libapriltag's own picture of it has them.
  std::array<std::array<double, 2>, 4> corners() const {
    const double c = std::cos(angle) * side / 2, s = std::sin(angle) * side / 2;
    return {{{x - c + s, y - s - c}, {x + c + s, y + s - c}, {x + c - s, y + s + c}, {x - c - s, y - s + c}}};
  }
};

// Seeded: a centre within half a pixel of the middle, 60 to 80 px wide, turned anyhow.
inline DrawnTag random_tag(unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const double x = 100 + unit(bits), y = 90 + unit(bits), side = 60 + 20 * unit(bits);
  return {x, y, side, 6.28 * unit(bits)};
}

// 200 x 180 grey values, row by row. noise: grey levels, 1 sigma.
inline std::vector<unsigned char> draw(apriltag_family_t* family, unsigned id, DrawnTag tag, double noise,
                                       int width = 200, int height = 180) {
  image_u8_t* code = apriltag_to_image(family, id);
  const int fine = 8;
  const double cell = tag.side / family->width_at_border, c = std::cos(tag.angle), s = std::sin(tag.angle);
  std::mt19937 bits(id + 1);
  std::normal_distribution<double> grain(0, 1);
  std::vector<unsigned char> grey;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int j = 0; j < fine; ++j)
        for (int i = 0; i < fine; ++i) {
          // A pixel gathers light from 1.6 px: a lens that is a little soft.
          const double dx = x + 0.5 + 1.6 * ((i + 0.5) / fine - 0.5) - tag.x;
          const double dy = y + 0.5 + 1.6 * ((j + 0.5) / fine - 0.5) - tag.y;
          const double u = (c * dx + s * dy) / cell + code->width / 2.0,
                       v = (c * dy - s * dx) / cell + code->height / 2.0;
          const bool inside = u >= 0 && v >= 0 && u < code->width && v < code->height;
          const bool white = !inside || code->buf[static_cast<int>(v) * code->stride + static_cast<int>(u)] > 0;
          sum += white ? 220 : 20;
        }
      grey.push_back(
          static_cast<unsigned char>(std::clamp(sum / (fine * fine) + noise * grain(bits), 0.0, 255.0) + 0.5));
    }
  image_u8_destroy(code);
  return grey;
}

inline image_u8_t wrap(std::vector<unsigned char>& grey, int width = 200, int height = 180) {
  return {width, height, width, grey.data()};
}
