#include "app/live/live_window.h"

#define GLFW_INCLUDE_NONE  // OpenGL ES comes from elsewhere
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "app/live/live_panel.h"
#include "app/window/desktop_window.h"

namespace app {
namespace {

constexpr std::chrono::seconds kMessageStays{4};
constexpr const char* kWithoutDisplay = "give --headless and --record";

}  // namespace

struct LiveWindow::Impl {
  DesktopWindow window;
  WindowPanel panel;
  bool panel_shown = true;
  bool help_shown = false;
  WindowRequests requests;
  std::string message;
  LiveClock::time_point message_until;

  Impl(const ar::PixelFormat& format, const std::string& title) : window(format, title, kWithoutDisplay) {}
  void on_key(int key);
  void draw_overlay(const WindowFacts& facts) const;
};

void LiveWindow::Impl::on_key(int key) {
  switch (key) {
    case GLFW_KEY_H:
      help_shown = !help_shown;
      break;
    case GLFW_KEY_P:
      panel_shown = !panel_shown;
      break;
    case GLFW_KEY_F:
    case GLFW_KEY_F11:
      window.set_full_screen(!window.full_screen());
      break;
    case GLFW_KEY_S:
      requests.still = true;
      break;
    case GLFW_KEY_W:
      requests.save = true;
      break;
    case GLFW_KEY_Q:
    case GLFW_KEY_ESCAPE:
      requests.close = true;
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
    : impl_(std::make_unique<Impl>(format, title)) {
  if (full_screen) impl_->window.set_full_screen(true);
}

LiveWindow::~LiveWindow() = default;

WindowRequests LiveWindow::show(const ShownPicture& shown, const WindowFacts& facts, const LiveSettings& settings) {
  Impl& impl = *impl_;
  impl.requests = {};
  impl.window.begin_frame();
  for (int key : impl.window.pressed_keys()) impl.on_key(key);
  impl.panel.note(facts, impl.window.swap_ms());
  LiveSettings changed = settings;
  if (impl.panel_shown && impl.panel.draw(facts, changed, impl.requests)) impl.requests.settings = changed;
  if (impl.help_shown) WindowPanel::draw_help();
  impl.draw_overlay(facts);
  impl.window.upload(shown.picture);
  impl.window.show();
  impl.requests.close = impl.requests.close || impl.window.closed();
  return impl.requests;
}

void LiveWindow::say(const std::string& message) {
  impl_->message = message;
  impl_->message_until = LiveClock::now() + kMessageStays;
}

double LiveWindow::swap_ms() const {
  return impl_->window.swap_ms();
}

}  // namespace app
