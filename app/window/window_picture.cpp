#include "app/window/window_picture.h"

#include <algorithm>

#include "app/process/bridge.h"
#include "render/composite/picture_math.h"
#include "render/composite/planes.h"

namespace app {

std::array<int, 4> letterboxed(int picture_width, int picture_height, int window_width, int window_height) {
  const double scale =
      std::min(static_cast<double>(window_width) / picture_width, static_cast<double>(window_height) / picture_height);
  const int width = std::max(1, static_cast<int>(picture_width * scale));
  const int height = std::max(1, static_cast<int>(picture_height * scale));
  return {(window_width - width) / 2, (window_height - height) / 2, width, height};
}

WindowPicture::WindowPicture(const ar::PixelFormat& format)
    : format_(format),
      program_("window/picture.vert", "window/picture.frag",
               format.bit_depth > 8 ? render::gl::Defines{{"TWO_BYTES"}} : render::gl::Defines{}) {
  const render::PictureFormat meaning = to_render(format);
  const bool words = format.bit_depth > 8;
  for (int p = 0; p < 3; ++p) {
    const glm::ivec2 size = render::plane_size(meaning, p);
    planes_.at(static_cast<std::size_t>(p)) =
        render::gl::Texture(words ? GL_RG8 : GL_R8, size.x, size.y,
                            words ? render::gl::Filter::Nearest : render::gl::Filter::Linear, 1, "shown plane");
  }
  const render::CodeTransform decode = render::rgb_from_code(meaning);
  program_.set("rgb_from_code", glm::mat3(decode.matrix));
  program_.set("rgb_offset", glm::vec3(decode.offset));
}

void WindowPicture::upload(const ar::OutputFrame& picture) {
  const GLenum channels = format_.bit_depth > 8 ? GL_RG : GL_RED;
  for (std::size_t p = 0; p < 3; ++p) {
    render::gl::Texture& plane = planes_.at(p);
    plane.upload(0, 0, plane.width(), plane.height(), channels, GL_UNSIGNED_BYTE, picture.plane.at(p),
                 picture.stride_bytes.at(p));
  }
}

void WindowPicture::draw(int window_width, int window_height) const {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  const auto [x, y, width, height] = letterboxed(format_.width, format_.height, window_width, window_height);
  glViewport(x, y, width, height);
  draw_planes();
}

void WindowPicture::draw_part(const cv::Rect2d& frame, const cv::Point2d& px, double zoom) const {
  const cv::Point2d middle(frame.x + 0.5 * frame.width, frame.y + 0.5 * frame.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(cvRound(frame.x), cvRound(frame.y), cvRound(frame.width), cvRound(frame.height));
  glClear(GL_COLOR_BUFFER_BIT);
  const int width = cvRound(zoom * format_.width);
  const int height = cvRound(zoom * format_.height);
  // Row 0 is at the viewport's top.
  glViewport(cvRound(middle.x - zoom * (px.x + 0.5)), cvRound(middle.y - height + zoom * (px.y + 0.5)), width, height);
  draw_planes();
  glDisable(GL_SCISSOR_TEST);
}

void WindowPicture::draw_planes() const {
  program_.use();
  program_.bind("plane0", planes_[0].handle());
  program_.bind("plane1", planes_[1].handle());
  program_.bind("plane2", planes_[2].handle());
  render::gl::draw_full_screen(no_vertices_);
}

}  // namespace app
