#include "app/calibration/gather_window.h"

#define GLFW_INCLUDE_NONE  // OpenGL ES comes from elsewhere
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "app/process/bridge.h"
#include "render/composite/composite_pass.h"

namespace app {
namespace {

constexpr std::size_t kTelling = 3;  // views before which nothing is known about the camera
constexpr int kFlashFrames = 5;
constexpr ImU32 kCovered = IM_COL32(60, 200, 90, 60);
constexpr ImU32 kAsked = IM_COL32(255, 210, 60, 255);
constexpr ImU32 kStill = IM_COL32(80, 255, 120, 255);
constexpr ImU32 kMoving = IM_COL32(255, 120, 80, 255);
constexpr ImU32 kTakenFlash = IM_COL32(255, 255, 255, 90);
constexpr std::array kTiltNames{"facing", "left nearer", "right nearer", "top nearer", "bottom nearer"};
constexpr std::array kReachNames{"near", "middle", "far"};

ImVec2 to_gui(const cv::Point2d& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y)};
}

// "left nearer 3", dim where there is none yet.
void draw_count(const char* name, int views) {
  const ImVec4 color = views > 0 ? ImVec4(0.5F, 1.0F, 0.6F, 1.0F) : ImVec4(1.0F, 0.6F, 0.4F, 1.0F);
  ImGui::SameLine();
  ImGui::TextColored(color, "%s %d ", name, views);
}

void draw_panel(const calib::ViewCollector& collector, calib::FrameUse use, const std::string& lost) {
  const calib::ViewCoverage& coverage = collector.coverage();
  // Where it does not hide the view that is asked for.
  const bool at_foot = collector.next().row == 0;
  const float height = ImGui::GetIO().DisplaySize.y;
  ImGui::SetNextWindowPos({10.0F, at_foot ? height - 10.0F : 10.0F}, ImGuiCond_Always, {0.0F, at_foot ? 1.0F : 0.0F});
  ImGui::SetNextWindowBgAlpha(0.6F);
  ImGui::Begin("Calibration", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextColored({1.0F, 0.85F, 0.3F, 1.0F}, "hold the board %s,", calib::words_of_place(collector.next()).c_str());
  ImGui::TextColored({1.0F, 0.85F, 0.3F, 1.0F}, "%s", calib::words_of_attitude(collector.next()).c_str());
  ImGui::TextUnformatted(lost.empty() ? calib::to_string(use) : ("camera lost: " + lost).c_str());
  ImGui::ProgressBar(
      static_cast<float>(coverage.picture), {300.0F, 0.0F},
      fmt::format("views: {}, {:.0f} % of the picture", collector.taken().size(), 100.0 * coverage.picture).c_str());
  ImGui::TextUnformatted("tilts:    ");
  for (std::size_t i = 0; i < kTiltNames.size(); ++i) draw_count(kTiltNames.at(i), coverage.tilts.at(i));
  ImGui::TextUnformatted("distances:");
  for (std::size_t i = 0; i < kReachNames.size(); ++i) draw_count(kReachNames.at(i), coverage.reaches.at(i));
  if (collector.taken().size() >= kTelling) {
    ImGui::Text("a direction will be known to about %.2f px", collector.expected_sigma_px());
  }
  ImGui::TextUnformatted("Backspace: without the last view   Enter: enough, solve   f: full screen");
  ImGui::End();
}

}  // namespace

GatherWindow::GatherWindow(const ar::SourceInfo& source)
    : window_(source.format, "Skyshaft: calibrating " + source.name, "give --headless"), pool_(source.format) {
  ar::OutputFrame blank = pool_.allocate();
  for (std::size_t p = 0; p < 3; ++p) {
    const bool halved = p > 0 && source.format.chroma == ar::Chroma::C420;
    const int rows = halved ? (source.format.height + 1) / 2 : source.format.height;
    std::memset(blank.plane.at(p), 1, static_cast<std::size_t>(rows * blank.stride_bytes.at(p)));
  }
  window_.upload(blank);
}

void GatherWindow::upload(const ar::Frame& frame) {
  const ar::OutputFrame picture = pool_.allocate();
  render::copy_picture(view_of(frame), view_of(picture));
  window_.upload(picture);
}

void GatherWindow::draw_coverage(const calib::ViewCoverage& coverage) const {
  const calib::Grid& grid = coverage.grid;
  const cv::Point2d half(0.48 * grid.width / grid.columns, 0.48 * grid.height / grid.rows);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (coverage.corners[i] == 0) continue;
    ImGui::GetBackgroundDrawList()->AddRectFilled(to_gui(window_.window_from_picture(grid.middle(i) - half)),
                                                  to_gui(window_.window_from_picture(grid.middle(i) + half)), kCovered);
  }
}

void GatherWindow::draw_points(const calib::Observation& seen, calib::FrameUse use) const {
  const ImU32 color = use == calib::FrameUse::Moving || use == calib::FrameUse::Blurred ? kMoving : kStill;
  for (const cv::Point2d& px : seen.px) {
    ImGui::GetBackgroundDrawList()->AddCircleFilled(to_gui(window_.window_from_picture(px)), 2.5F, color);
  }
}

// The hull of where the board's points are to be.
void GatherWindow::draw_asked(const std::vector<cv::Point2d>& px) const {
  if (px.size() < 3) return;
  std::vector<cv::Point2f> points(px.begin(), px.end());
  std::vector<cv::Point2f> hull;
  cv::convexHull(points, hull);
  std::vector<ImVec2> line;
  line.reserve(hull.size());
  for (const cv::Point2f& p : hull) line.push_back(to_gui(window_.window_from_picture(p)));
  ImGui::GetBackgroundDrawList()->AddPolyline(line.data(), static_cast<int>(line.size()), kAsked, ImDrawFlags_Closed,
                                              3.0F);
}

GatherRequest GatherWindow::show(const calib::ViewCollector& collector, const calib::Observation& seen,
                                 calib::FrameUse use, const std::string& lost) {
  window_.begin_frame();
  GatherRequest request = window_.closed() ? GatherRequest::Finish : GatherRequest::None;
  for (int key : window_.pressed_keys()) {
    if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER || key == GLFW_KEY_Q || key == GLFW_KEY_ESCAPE) {
      request = GatherRequest::Finish;
    }
    if (key == GLFW_KEY_BACKSPACE) request = GatherRequest::DropLast;
    if (key == GLFW_KEY_F || key == GLFW_KEY_F11) window_.set_full_screen(!window_.full_screen());
  }
  if (collector.taken().size() > views_) flash_ = kFlashFrames;
  views_ = collector.taken().size();
  draw_coverage(collector.coverage());
  draw_asked(collector.next_px());
  draw_points(seen, use);
  if (flash_ > 0) {
    --flash_;
    ImGui::GetForegroundDrawList()->AddRectFilled({0.0F, 0.0F}, ImGui::GetIO().DisplaySize, kTakenFlash);
  }
  draw_panel(collector, use, lost);
  window_.show();
  return request;
}

}  // namespace app
