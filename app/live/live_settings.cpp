#include "app/live/live_settings.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "app/process/output_files.h"
#include "app/scene_file/yaml_edit.h"

namespace app {
namespace {

std::string number(double value) {
  return fmt::format("{:.6g}", value);
}

// A scene's text that takes values as they differ.
class Edit {
 public:
  explicit Edit(std::string text) : text_(std::move(text)) {}

  void set(const std::vector<std::string>& path, const std::string& value) {
    text_ = with_yaml_value(text_, path, value);
  }
  void set_changed(const std::vector<std::string>& path, double before, double after) {
    if (before != after) set(path, number(after));
  }
  bool has(const std::string& word) const { return text_.find(word) != std::string::npos; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void edit_conditions(const Conditions& before, const Conditions& after, double now_s, Edit& edit) {
  if (after.place && before.place) {
    edit.set_changed({"place", "latitude"}, before.place->latitude_deg, after.place->latitude_deg);
    edit.set_changed({"place", "longitude"}, before.place->longitude_deg, after.place->longitude_deg);
    edit.set_changed({"place", "height"}, before.place->height_m, after.place->height_m);
  }
  if (after.time && after.time != before.time) {
    const auto now = *after.time + std::chrono::seconds(static_cast<std::int64_t>(now_s));
    edit.set({"time"}, ar::format_time(std::chrono::floor<std::chrono::seconds>(now)));
  }
}

void edit_medium(const LiveSettings& before, const LiveSettings& after, Edit& edit) {
  if (!after.medium || !before.medium) return;
  const render::Medium& was = *before.medium;
  const render::Medium& now = *after.medium;
  if (was.extinction_per_m != now.extinction_per_m) {
    if (edit.has("extinction:")) {
      edit.set({"medium", "extinction"}, number(now.extinction_per_m));
    } else {
      edit.set({"medium", "visibility"}, number(2.996 / now.extinction_per_m));
    }
  }
  edit.set_changed({"medium", "albedo"}, was.albedo, now.albedo);
  edit.set_changed({"medium", "g"}, was.g, now.g);
}

}  // namespace

void save_settings(const std::filesystem::path& scene, const LiveSettings& before, const LiveSettings& after,
                   double now_s) {
  std::ifstream file(scene, std::ios::binary);
  Edit edit(std::string(std::istreambuf_iterator<char>(file), {}));
  if (!file) throw std::runtime_error(scene.string() + ": cannot be read");
  edit_conditions(before.conditions, after.conditions, now_s, edit);
  if (before.sky.options.model != after.sky.options.model) edit.set({"sky", "model"}, after.sky.options.model);
  edit.set_changed({"sky", "turbidity"}, before.sky.options.turbidity, after.sky.options.turbidity);
  if (before.sky.options.clouds.preset != after.sky.options.clouds.preset) {
    edit.set({"sky", "clouds", "preset"}, after.sky.options.clouds.preset);
  }
  edit_medium(before, after, edit);
  if (before.quality.shafts != after.quality.shafts) {
    edit.set({"quality", "shafts"}, render::to_text(after.quality.shafts));
  }
  if (before.target_ms != after.target_ms && after.target_ms > 0.0) {
    edit.set({"quality", "target_ms"}, number(after.target_ms));
  }
  if (after.exposure_source == ExposureSource::Manual) {
    edit.set({"exposure", "white_luminance"}, number(1.0 / after.manual_exposure));
  }
  write_whole(scene, edit.text(), true);
}

}  // namespace app
