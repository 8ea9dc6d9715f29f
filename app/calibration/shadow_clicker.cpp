#include "app/calibration/shadow_clicker.h"

#define GLFW_INCLUDE_NONE  // OpenGL ES comes from elsewhere
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <vector>

#include "app/process/bridge.h"
#include "app/window/desktop_window.h"
#include "ar/output/frame_pool.h"
#include "render/composite/composite_pass.h"

namespace app {
namespace {

constexpr ImU32 kMark = IM_COL32(255, 80, 60, 255);
constexpr ImU32 kFrame = IM_COL32(255, 255, 255, 200);
constexpr double kMagnifier = 180.0;  // side, window units
constexpr double kZoom = 6.0;         // window units a pixel in it
constexpr double kOff = 24.0;         // from the cursor

ImVec2 to_gui(const cv::Point2d& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

class Clicker {
 public:
  Clicker(const ar::Frame& photo, const std::string& name)
      : window_(photo.format, "Skyshaft: shadow in " + name, "give --base X,Y and --tip X,Y in pixels") {
    ar::FramePool pool(photo.format);
    const ar::OutputFrame picture = pool.allocate();
    render::copy_picture(view_of(photo), view_of(picture));
    window_.upload(picture);
  }

  std::optional<ShadowPixels> run() {
    while (!window_.closed() && !accepted_) frame();
    if (!accepted_) return std::nullopt;
    return ShadowPixels{clicks_[0], clicks_[1]};
  }

 private:
  void frame() {
    window_.begin_frame();
    for (int key : window_.pressed_keys()) on_key(key);
    const auto cursor = window_.cursor_px();
    if (cursor && clicks_.size() < 2 && ImGui::IsMouseClicked(ImGuiMouseButton_Left) &&
        !ImGui::GetIO().WantCaptureMouse) {
      clicks_.push_back(*cursor);
    }
    draw_marks();
    draw_words();
    if (cursor && clicks_.size() < 2) magnify(*cursor);
    window_.show();
  }

  void on_key(int key) {
    if ((key == GLFW_KEY_BACKSPACE || key == GLFW_KEY_ESCAPE) && !clicks_.empty()) clicks_.pop_back();
    if ((key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER) && clicks_.size() == 2) accepted_ = true;
  }

  void draw_marks() const {
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    for (const cv::Point2d& click : clicks_) {
      const ImVec2 at = to_gui(window_.window_from_picture(click));
      list->AddCircle(at, 8.0F, kMark, 24, 2.0F);
      list->AddLine({at.x - 12.0F, at.y}, {at.x + 12.0F, at.y}, kMark);
      list->AddLine({at.x, at.y - 12.0F}, {at.x, at.y + 12.0F}, kMark);
    }
    if (clicks_.size() < 2) return;
    list->AddLine(to_gui(window_.window_from_picture(clicks_[0])), to_gui(window_.window_from_picture(clicks_[1])),
                  kMark, 2.0F);
  }

  void draw_words() const {
    static constexpr const char* kSteps[] = {
        "click where the upright edge meets the ground",
        "click a point of that edge's shadow, far from its foot\nBackspace: once more",
        "Enter: accept\nBackspace: the shadow's point once more"};
    ImGui::SetNextWindowPos({10.0F, 10.0F}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.6F);
    ImGui::Begin("North by a shadow", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextUnformatted(kSteps[clicks_.size()]);
    ImGui::End();
  }

  // Beside the cursor, on the side where there is room.
  void magnify(const cv::Point2d& px) {
    const ImGuiIO& io = ImGui::GetIO();
    const double x = io.MousePos.x + kOff + kMagnifier < io.DisplaySize.x ? kOff : -kOff - kMagnifier;
    const double y = io.MousePos.y + kOff + kMagnifier < io.DisplaySize.y ? kOff : -kOff - kMagnifier;
    const cv::Rect2d frame(io.MousePos.x + x, io.MousePos.y + y, kMagnifier, kMagnifier);
    window_.magnify(px, kZoom, frame);
    ImDrawList* list = ImGui::GetForegroundDrawList();
    const cv::Point2d middle = 0.5 * (frame.tl() + frame.br());
    list->AddRect(to_gui(frame.tl()), to_gui(frame.br()), kFrame);
    list->AddLine(to_gui(middle - cv::Point2d(12.0, 0.0)), to_gui(middle + cv::Point2d(12.0, 0.0)), kMark);
    list->AddLine(to_gui(middle - cv::Point2d(0.0, 12.0)), to_gui(middle + cv::Point2d(0.0, 12.0)), kMark);
  }

  DesktopWindow window_;
  std::vector<cv::Point2d> clicks_;
  bool accepted_ = false;
};

}  // namespace

std::optional<ShadowPixels> click_shadow(const ar::Frame& photo, const std::string& name) {
  return Clicker(photo, name).run();
}

}  // namespace app
