#pragma once

namespace render {

// Pixels [x, x + width) x [y, y + height) of a picture, row 0 at the top.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool empty() const { return width <= 0 || height <= 0; }
};

// The smallest rectangle that holds both; an empty one adds nothing.
PixelRect united(const PixelRect& a, const PixelRect& b);

}  // namespace render
