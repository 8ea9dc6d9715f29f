#include "app/live/window.h"

#define GLFW_INCLUDE_NONE  // OpenGL ES comes from elsewhere
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <stdexcept>

#include "app/live/window_gui.h"
#include "app/live/window_panel.h"
#include "app/live/window_picture.h"
#include "render/gl/extensions.h"

namespace app {
namespace {

constexpr std::chrono::seconds kMessageStays{4};

[[noreturn]] void fail(const char* what) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  throw std::runtime_error(fmt::format(
      "{}: {}\nstart it on a desktop (DISPLAY or WAYLAND_DISPLAY tells which), or give --headless and --record", what,
      reason != nullptr ? reason : "no reason given"));
}

// The library, while it lives.
struct Glfw {
  Glfw() {
    if (glfwInit() != GLFW_TRUE) fail("there is no display for a window");
  }
  ~Glfw() { glfwTerminate(); }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
};

struct CloseWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};

std::unique_ptr<GLFWwindow, CloseWindow> open_window(const ar::PixelFormat& format, const std::string& title) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
  std::unique_ptr<GLFWwindow, CloseWindow> window(
      glfwCreateWindow(format.width, format.height, title.c_str(), nullptr, nullptr));
  if (!window) fail("no window with OpenGL ES 3.1 can be opened");
  return window;
}

}  // namespace

struct LiveWindow::Impl {
  Glfw glfw;
  std::unique_ptr<GLFWwindow, CloseWindow> window;
  render::gl::Extensions extensions;
  std::unique_ptr<WindowPicture> picture;
  std::unique_ptr<WindowGui> gui;
  WindowPanel panel;
  bool panel_shown = true;
  bool help_shown = false;
  bool full_screen = false;
  int windowed[4] = {60, 60, 0, 0};  // place and size before full screen
  WindowWishes wishes;
  std::string message;
  LiveClock::time_point message_until;
  LiveClock::time_point last_frame = LiveClock::now();
  double swap_ms = 0.0;

  void set_full_screen(bool on);
  void on_key(int key);
  void make_current() const;
  void draw_overlay(const WindowFacts& facts) const;
};

void LiveWindow::Impl::make_current() const {
  glfwMakeContextCurrent(window.get());
  render::gl::detail::set_current_extensions(&extensions);
}

void LiveWindow::Impl::set_full_screen(bool on) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  if (on) {
    glfwGetWindowPos(window.get(), &windowed[0], &windowed[1]);
    glfwGetWindowSize(window.get(), &windowed[2], &windowed[3]);
    glfwSetWindowMonitor(window.get(), monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    glfwSetWindowMonitor(window.get(), nullptr, windowed[0], windowed[1], windowed[2], windowed[3], 0);
  }
  full_screen = on;
}

void LiveWindow::Impl::on_key(int key) {
  if (WindowGui::wants_keyboard()) return;
  switch (key) {
    case GLFW_KEY_H:
      help_shown = !help_shown;
      break;
    case GLFW_KEY_P:
      panel_shown = !panel_shown;
      break;
    case GLFW_KEY_F:
    case GLFW_KEY_F11:
      set_full_screen(!full_screen);
      break;
    case GLFW_KEY_S:
      wishes.still = true;
      break;
    case GLFW_KEY_W:
      wishes.save = true;
      break;
    case GLFW_KEY_Q:
    case GLFW_KEY_ESCAPE:
      wishes.close = true;
      break;
    default:
      break;
  }
}

// A line at the foot of the picture: what is wrong, or what was just done.
void LiveWindow::Impl::draw_overlay(const WindowFacts& facts) const {
  std::string line;
  if (LiveClock::now() < message_until) line = message;
  if (!facts.lost.empty()) line = "camera lost, waiting for it: " + facts.lost;
  if (line.empty()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2.0F, size.y - 20.0F}, ImGuiCond_Always, {0.5F, 1.0F});
  ImGui::Begin("message", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted(line.c_str());
  ImGui::End();
}

LiveWindow::LiveWindow(const ar::PixelFormat& format, const std::string& title, bool full_screen)
    : impl_(std::make_unique<Impl>()) {
  impl_->window = open_window(format, title);
  GLFWwindow* window = impl_->window.get();
  glfwMakeContextCurrent(window);
  impl_->extensions = render::gl::detail::load_extensions();
  impl_->make_current();
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window, impl_.get());
  glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int /*scancode*/, int action, int /*modifiers*/) {
    if (action == GLFW_PRESS) static_cast<Impl*>(glfwGetWindowUserPointer(of))->on_key(key);
  });
  impl_->picture = std::make_unique<WindowPicture>(format);
  impl_->gui = std::make_unique<WindowGui>(window);
  if (full_screen) impl_->set_full_screen(true);
}

LiveWindow::~LiveWindow() {
  impl_->make_current();
  impl_->gui.reset();
  impl_->picture.reset();
  render::gl::detail::set_current_extensions(nullptr);
}

WindowWishes LiveWindow::show(const ShownPicture& shown, const WindowFacts& facts, const LiveSettings& settings) {
  Impl& impl = *impl_;
  impl.make_current();
  impl.wishes = {};
  glfwPollEvents();
  const LiveClock::time_point now = LiveClock::now();
  impl.gui->begin_frame(milliseconds_between(impl.last_frame, now) / 1e3);
  impl.last_frame = now;
  impl.panel.note(facts, impl.swap_ms);
  LiveSettings changed = settings;
  if (impl.panel_shown && impl.panel.draw(facts, changed, impl.wishes)) impl.wishes.settings = changed;
  if (impl.help_shown) WindowPanel::draw_help();
  impl.draw_overlay(facts);
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(impl.window.get(), &width, &height);
  impl.picture->upload(shown.picture);
  impl.picture->draw(width, height);
  impl.gui->draw();
  glfwSwapBuffers(impl.window.get());
  impl.swap_ms = milliseconds_between(now, LiveClock::now());
  impl.wishes.close = impl.wishes.close || glfwWindowShouldClose(impl.window.get()) == GLFW_TRUE;
  return impl.wishes;
}

void LiveWindow::say(const std::string& message) {
  impl_->message = message;
  impl_->message_until = LiveClock::now() + kMessageStays;
}

double LiveWindow::swap_ms() const {
  return impl_->swap_ms;
}

}  // namespace app
