#pragma once

#include "render/gl/buffer.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"

struct GLFWwindow;
struct ImGuiContext;

namespace app {

// Dear ImGui on a GLFW window with OpenGL ES 3: input in, triangles out. One at a time; on the main thread with the
// window's context current.
class WindowGui {
 public:
  explicit WindowGui(GLFWwindow* window);
  ~WindowGui();
  WindowGui(const WindowGui&) = delete;
  WindowGui& operator=(const WindowGui&) = delete;

  void begin_frame(double seconds_since_last);
  void draw();
  // The keys go to a field of the panel.
  static bool wants_keyboard();

 private:
  void make_font();

  GLFWwindow* window_;
  ImGuiContext* context_;
  render::gl::Program program_;
  render::gl::Texture font_;
  unsigned vertex_array_ = 0;
  unsigned vertices_ = 0;
  unsigned indices_ = 0;
};

}  // namespace app
