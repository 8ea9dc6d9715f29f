#pragma once

#include <array>
#include <opencv2/core/types.hpp>

#include "ar/output/sink.h"
#include "render/gl/buffer.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"

namespace app {

// Draws a video picture into the window, as large as fits, the rest black.
class WindowPicture {
 public:
  explicit WindowPicture(const ar::PixelFormat& format);

  void upload(const ar::OutputFrame& picture);
  void draw(int window_width, int window_height) const;
  // The picture about `px` (OpenCV's count), `zoom` window pixels a pixel, within `frame`: window pixels from the
  // bottom left.
  void draw_part(const cv::Rect2d& frame, const cv::Point2d& px, double zoom) const;

 private:
  void draw_planes() const;

  ar::PixelFormat format_;
  std::array<render::gl::Texture, 3> planes_;
  render::gl::Program program_;
  render::gl::VertexArray no_vertices_;
};

// The largest rectangle of the picture's aspect in the middle of the window: x, y, width, height, from the bottom left.
std::array<int, 4> letterboxed(int picture_width, int picture_height, int window_width, int window_height);

}  // namespace app
