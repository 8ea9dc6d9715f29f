#include "app/live/live_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "render/shafts/shaft_settings.h"
#include "render/sky/clouds.h"
#include "render/sky/sky_models.h"

namespace app {
namespace {

constexpr const char* kKeyHelp =
    "h  these keys\np  panel on and off\nf  full screen\ns  still picture\nw  write changes into the scene file\nq  "
    "quit";

// One of several words.
bool choose(const char* label, std::string& chosen, const std::vector<std::string>& words) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, chosen.c_str())) return false;
  for (const std::string& word : words) {
    if (ImGui::Selectable(word.c_str(), word == chosen) && word != chosen) {
      chosen = word;
      changed = true;
    }
  }
  ImGui::EndCombo();
  return changed;
}

bool slide(const char* label, double& value, double low, double high, const char* format, bool logarithmic = false) {
  return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format,
                             logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_AlwaysClamp);
}

bool draw_place(ar::GeoPosition& place) {
  bool changed = ImGui::InputDouble("latitude", &place.latitude_deg, 0.0, 0.0, "%.5f");
  changed |= ImGui::InputDouble("longitude", &place.longitude_deg, 0.0, 0.0, "%.5f");
  changed |= ImGui::InputDouble("height, m", &place.height_m, 0.0, 0.0, "%.0f");
  place.latitude_deg = std::clamp(place.latitude_deg, -90.0, 90.0);
  place.longitude_deg = std::clamp(place.longitude_deg, -180.0, 180.0);
  return changed;
}

// The date, and a slider that runs the sun through the day. Universal time.
bool draw_time(ar::UtcTime& first_frame, double elapsed_s) {
  const auto elapsed = std::chrono::microseconds(std::llround(elapsed_s * 1e6));
  const ar::UtcTime now = first_frame + elapsed;
  const auto midnight = std::chrono::floor<std::chrono::days>(now);
  const std::chrono::year_month_day date(midnight);
  int fields[3] = {static_cast<int>(date.year()), static_cast<int>(static_cast<unsigned>(date.month())),
                   static_cast<int>(static_cast<unsigned>(date.day()))};
  double hours = std::chrono::duration<double, std::ratio<3600>>(now - midnight).count();
  bool changed = ImGui::InputInt3("year month day", fields);
  changed |= slide("hours UTC", hours, 0.0, 23.999, "%.2f");
  if (!changed) return false;
  const std::chrono::year_month_day wanted{std::chrono::year(std::clamp(fields[0], 1900, 2100)),
                                           std::chrono::month(static_cast<unsigned>(std::clamp(fields[1], 1, 12))),
                                           std::chrono::day(static_cast<unsigned>(std::clamp(fields[2], 1, 31)))};
  const auto day = wanted.ok() ? std::chrono::sys_days(wanted) : midnight;
  first_frame = ar::UtcTime(day) + std::chrono::microseconds(std::llround(hours * 3600e6)) - elapsed;
  return true;
}

// What can follow a slider: families of many skies below the single ones.
std::vector<std::string> quick_sky_models() {
  std::vector<std::string> single;
  std::vector<std::string> families;
  for (const render::SkyModelInfo& model : render::sky_models()) {
    if (!model.quick) continue;
    std::vector<std::string>& list = model.words.size() == 1 ? single : families;
    list.insert(list.end(), model.words.begin(), model.words.end());
  }
  single.insert(single.end(), families.begin(), families.end());
  return single;
}

bool draw_sky(render::SkyOptions& sky) {
  bool changed = choose("sky", sky.model, quick_sky_models());
  changed |= slide("turbidity", sky.turbidity, 1.7, 12.0, "%.1f");
  changed |= choose("clouds", sky.clouds.preset, render::cloud_preset_names());
  return changed;
}

bool draw_medium(std::optional<render::Medium>& medium) {
  bool there = medium.has_value();
  bool changed = ImGui::Checkbox("haze", &there);
  if (changed && there) medium = render::Medium{.extinction_per_m = render::extinction_from_visibility(60.0)};
  if (changed && !there) medium.reset();
  if (!medium) return changed;
  double visibility_m = medium->extinction_per_m > 0.0 ? 2.996 / medium->extinction_per_m : 10'000.0;
  if (slide("visibility, m", visibility_m, 2.0, 10'000.0, "%.0f", true)) {
    medium->extinction_per_m = render::extinction_from_visibility(visibility_m);
    changed = true;
  }
  changed |= slide("albedo", medium->albedo, 0.0, 1.0, "%.2f");
  changed |= slide("forward g", medium->g, -0.95, 0.95, "%.2f");
  return changed;
}

bool draw_quality(LiveSettings& settings) {
  std::vector<std::string> techniques{"auto"};
  for (const auto& technique : render::shaft_techniques()) {
    if (technique.name != "reference") techniques.push_back(technique.name);
  }
  render::Quality& quality = settings.quality;
  bool changed = false;
  std::string technique = quality.shafts.technique;
  if (choose("shafts", technique, techniques)) {
    quality.shafts = {.technique = technique};
    changed = true;
  }
  changed |= ImGui::Checkbox("smooth edges", &quality.anti_alias);
  changed |= slide("drawn at", quality.render_scale, 0.2, 1.0, "%.2f of full size");
  changed |= slide("time to draw, ms", settings.target_ms, 0.0, 100.0, "%.0f (0: any)");
  return changed;
}

bool draw_exposure(LiveSettings& settings, double exposure) {
  int source = static_cast<int>(settings.exposure_source);
  bool changed = ImGui::Combo("exposure", &source, "scene or camera\0estimate\0by hand\0");
  if (changed && source == static_cast<int>(ExposureSource::Manual)) settings.manual_exposure = exposure;
  settings.exposure_source = static_cast<ExposureSource>(source);
  double white = 1.0 / (settings.exposure_source == ExposureSource::Manual ? settings.manual_exposure : exposure);
  if (slide("white, cd/m2", white, 1.0, 100'000.0, "%.0f", true) &&
      settings.exposure_source == ExposureSource::Manual) {
    settings.manual_exposure = 1.0 / white;
    changed = true;
  }
  return changed;
}

std::string how_it_fits(const TagState& tag) {
  if (!tag.position_m) return "not in the map";
  if (!tag.seen) return "not in view";
  return tag.rms_px ? fmt::format("off by {:.2f} px", *tag.rms_px) : "no pose";
}

// The map, each tag with its place in metres east, north and up, and how well it fits what was just seen.
void draw_tags(const std::vector<TagState>& tags) {
  constexpr std::size_t kRowsAtOnce = 6;
  const float row = ImGui::GetTextLineHeightWithSpacing();
  const auto rows = static_cast<float>(std::clamp<std::size_t>(tags.size(), 1, kRowsAtOnce));
  ImGui::BeginChild("tags", {0.0F, rows * row});
  if (tags.empty()) ImGui::TextUnformatted("no tag in view");
  for (const TagState& tag : tags) {
    const auto at = tag.position_m.value_or(std::array<double, 3>{});
    const std::string place = fmt::format("{:6.2f} {:6.2f} {:5.2f}", at[0], at[1], at[2]);
    ImGui::Text("tag %-3d %20s  %s", tag.id, tag.position_m ? place.c_str() : "", how_it_fits(tag).c_str());
  }
  ImGui::EndChild();
}

}  // namespace

void WindowPanel::note(const WindowFacts& facts, double show_ms) {
  const std::array<double, 4> times{facts.track_ms, facts.draw_ms, show_ms, facts.latency_ms};
  for (std::size_t i = 0; i < times.size(); ++i) graphs_.at(i).ms.at(at_) = static_cast<float>(times.at(i));
  at_ = (at_ + 1) % kGraphFrames;
}

void WindowPanel::draw_graphs() const {
  for (const Graph& graph : graphs_) {
    const float last = graph.ms.at((at_ + kGraphFrames - 1) % kGraphFrames);
    const std::string text = fmt::format("{:.1f} ms", last);
    ImGui::PlotLines(graph.name, graph.ms.data(), static_cast<int>(kGraphFrames), static_cast<int>(at_), text.c_str(),
                     0.0F, std::max(40.0F, *std::max_element(graph.ms.begin(), graph.ms.end())), {0.0F, 34.0F});
  }
}

bool WindowPanel::draw(const WindowFacts& facts, LiveSettings& settings, WindowRequests& requests) {
  ImGui::SetNextWindowPos({10.0F, 10.0F}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({350.0F, 0.0F}, ImGuiCond_FirstUseEver);
  bool changed = false;
  if (ImGui::Begin("Skyshaft")) {
    ImGui::PushItemWidth(180.0F);
    ImGui::Text("%s, %.1f a second, %lld dropped", facts.state.c_str(), facts.per_second,
                static_cast<long long>(facts.dropped));
    ImGui::Text("%s", facts.quality.c_str());
    if (settings.conditions.place) changed |= draw_place(*settings.conditions.place);
    if (settings.conditions.time) changed |= draw_time(*settings.conditions.time, facts.elapsed_s);
    ImGui::Separator();
    changed |= draw_sky(settings.sky.options);
    changed |= draw_medium(settings.medium);
    ImGui::Separator();
    changed |= draw_quality(settings);
    changed |= draw_exposure(settings, facts.exposure);
    ImGui::Separator();
    draw_tags(facts.tags);
    draw_graphs();
    requests.save |= ImGui::Button("write into the scene file");
    ImGui::SameLine();
    requests.still |= ImGui::Button("still");
    ImGui::PopItemWidth();
  }
  ImGui::End();
  return changed;
}

void WindowPanel::draw_help() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2.0F, size.y / 2.0F}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::Begin("Keys", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted(kKeyHelp);
  ImGui::End();
}

}  // namespace app
