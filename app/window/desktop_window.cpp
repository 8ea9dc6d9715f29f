#include "app/window/desktop_window.h"

#define GLFW_INCLUDE_NONE  // OpenGL ES comes from elsewhere
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "app/window/window_gui.h"
#include "app/window/window_picture.h"
#include "render/gl/extensions.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPartOfScreen = 0.9;
constexpr double kSmallestSide = 640.0;      // the longer one: a panel must have room
constexpr double kLargestViewport = 8192.0;  // that any GL has

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

[[noreturn]] void fail(const char* what, const std::string& otherwise) {
  const char* reason = nullptr;
  glfwGetError(&reason);
  throw std::runtime_error(fmt::format("{}: {}\nstart it on a desktop (DISPLAY or WAYLAND_DISPLAY tells which), or {}",
                                       what, reason != nullptr ? reason : "no reason given", otherwise));
}

// The library, while it lives.
struct Glfw {
  explicit Glfw(const std::string& otherwise) {
    if (glfwInit() != GLFW_TRUE) fail("there is no display for a window", otherwise);
  }
  ~Glfw() { glfwTerminate(); }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
};

struct CloseWindow {
  void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowPtr = std::unique_ptr<GLFWwindow, CloseWindow>;

// The picture's size, enlarged where it is tiny, reduced where it does not fit the screen.
cv::Size size_on_screen(const ar::PixelFormat& format) {
  const cv::Size size(format.width, format.height);
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return size;
  const double enlarged = std::max(1.0, kSmallestSide / std::max(size.width, size.height));
  const double scale =
      std::min({enlarged, kPartOfScreen * mode->width / size.width, kPartOfScreen * mode->height / size.height});
  return {std::max(1, cvRound(scale * size.width)), std::max(1, cvRound(scale * size.height))};
}

WindowPtr open_window(const ar::PixelFormat& format, const std::string& title, const std::string& otherwise) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
  const cv::Size size = size_on_screen(format);
  WindowPtr window(glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr));
  if (!window) fail("no window with OpenGL ES 3.1 can be opened", otherwise);
  return window;
}

struct Magnifier {
  cv::Point2d px;
  double zoom = 1.0;
  cv::Rect2d frame;
};

}  // namespace

struct DesktopWindow::Impl {
  Impl(const ar::PixelFormat& of, const std::string& title, const std::string& otherwise)
      : format(of), glfw(otherwise), window(open_window(of, title, otherwise)) {}

  ar::PixelFormat format;
  Glfw glfw;
  WindowPtr window;
  render::gl::Extensions extensions;
  std::unique_ptr<WindowPicture> picture;
  std::unique_ptr<WindowGui> gui;
  std::vector<int> arriving;  // keys
  std::vector<int> pressed;
  bool full_screen = false;
  int windowed[4] = {60, 60, 0, 0};  // place and size before full screen
  std::optional<Magnifier> magnifier;
  Clock::time_point last_frame = Clock::now();
  double swap_ms = 0.0;

  void make_current() const {
    glfwMakeContextCurrent(window.get());
    render::gl::detail::set_current_extensions(&extensions);
  }
  // The picture's rectangle in ImGui's coordinates, from the top left.
  cv::Rect2d picture_rect() const {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window.get(), &width, &height);
    const auto [x, y, w, h] = letterboxed(format.width, format.height, width, height);
    return {static_cast<double>(x), static_cast<double>(height - y - h), static_cast<double>(w),
            static_cast<double>(h)};
  }
  void draw_magnifier(int width, int height) const;
};

void DesktopWindow::Impl::draw_magnifier(int width, int height) const {
  int window_width = 0;
  int window_height = 0;
  glfwGetWindowSize(window.get(), &window_width, &window_height);
  const double scale = static_cast<double>(width) / std::max(1, window_width);
  const cv::Rect2d& f = magnifier->frame;
  const double zoom = std::min(magnifier->zoom * scale, kLargestViewport / std::max(format.width, format.height));
  picture->draw_part({f.x * scale, height - (f.y + f.height) * scale, f.width * scale, f.height * scale}, magnifier->px,
                     zoom);
}

DesktopWindow::DesktopWindow(const ar::PixelFormat& format, const std::string& title, const std::string& otherwise)
    : impl_(std::make_unique<Impl>(format, title, otherwise)) {
  GLFWwindow* window = impl_->window.get();
  glfwMakeContextCurrent(window);
  impl_->extensions = render::gl::detail::load_extensions();
  impl_->make_current();
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window, impl_.get());
  glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int /*scancode*/, int action, int /*modifiers*/) {
    if (action != GLFW_PRESS || WindowGui::wants_keyboard()) return;
    static_cast<Impl*>(glfwGetWindowUserPointer(of))->arriving.push_back(key);
  });
  impl_->picture = std::make_unique<WindowPicture>(format);
  impl_->gui = std::make_unique<WindowGui>(window);
}

DesktopWindow::~DesktopWindow() {
  impl_->make_current();
  impl_->gui.reset();
  impl_->picture.reset();
  render::gl::detail::set_current_extensions(nullptr);
}

void DesktopWindow::begin_frame() {
  Impl& impl = *impl_;
  impl.make_current();
  glfwPollEvents();
  impl.pressed = std::move(impl.arriving);
  impl.arriving.clear();
  impl.magnifier.reset();
  const Clock::time_point now = Clock::now();
  impl.gui->begin_frame(seconds_between(impl.last_frame, now));
  impl.last_frame = now;
}

const std::vector<int>& DesktopWindow::pressed_keys() const {
  return impl_->pressed;
}

bool DesktopWindow::closed() const {
  return glfwWindowShouldClose(impl_->window.get()) == GLFW_TRUE;
}

std::optional<cv::Point2d> DesktopWindow::cursor_px() const {
  const ImVec2 at = ImGui::GetIO().MousePos;
  const cv::Rect2d rect = impl_->picture_rect();
  if (!rect.contains({at.x, at.y})) return std::nullopt;
  return cv::Point2d((at.x + 0.5 - rect.x) * impl_->format.width / rect.width - 0.5,
                     (at.y + 0.5 - rect.y) * impl_->format.height / rect.height - 0.5);
}

cv::Point2d DesktopWindow::window_from_picture(const cv::Point2d& px) const {
  const cv::Rect2d rect = impl_->picture_rect();
  return {rect.x + (px.x + 0.5) * rect.width / impl_->format.width,
          rect.y + (px.y + 0.5) * rect.height / impl_->format.height};
}

void DesktopWindow::upload(const ar::OutputFrame& picture) {
  impl_->picture->upload(picture);
}

void DesktopWindow::magnify(const cv::Point2d& px, double zoom, const cv::Rect2d& frame) {
  impl_->magnifier = Magnifier{px, zoom, frame};
}

void DesktopWindow::show() {
  Impl& impl = *impl_;
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(impl.window.get(), &width, &height);
  impl.picture->draw(width, height);
  if (impl.magnifier) impl.draw_magnifier(width, height);
  impl.gui->draw();
  glfwSwapBuffers(impl.window.get());
  impl.swap_ms = 1e3 * seconds_between(impl.last_frame, Clock::now());
}

double DesktopWindow::swap_ms() const {
  return impl_->swap_ms;
}

bool DesktopWindow::full_screen() const {
  return impl_->full_screen;
}

void DesktopWindow::set_full_screen(bool on) {
  Impl& impl = *impl_;
  GLFWwindow* window = impl.window.get();
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  if (on) {
    glfwGetWindowPos(window, &impl.windowed[0], &impl.windowed[1]);
    glfwGetWindowSize(window, &impl.windowed[2], &impl.windowed[3]);
    glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    glfwSetWindowMonitor(window, nullptr, impl.windowed[0], impl.windowed[1], impl.windowed[2], impl.windowed[3], 0);
  }
  impl.full_screen = on;
}

}  // namespace app
