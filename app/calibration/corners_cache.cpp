#include "app/calibration/corners_cache.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "app/process/output_files.h"
#include "ar/error.h"

namespace app {
namespace {

using nlohmann::json;

// Size and time of change of a file; of the files in a folder or of a pattern, only the folder's own.
std::string stamp_of(const std::string& input) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::absolute(input, error);
  const auto time = std::filesystem::last_write_time(path, error);
  if (error) return "";
  const auto size = std::filesystem::is_regular_file(path, error) ? std::filesystem::file_size(path, error) : 0;
  return fmt::format("{} {} {}", path.string(), size, time.time_since_epoch().count());
}

json to_json(const calib::Observation& s) {
  json px = json::array();
  for (const cv::Point2d& p : s.px) px.push_back({p.x, p.y});
  return {{"name", s.name},
          {"time_s", s.time_s},
          {"edge_width_px", s.edge_width_px},
          {"foreign_ids", s.foreign_ids},
          {"points", s.points},
          {"px", px}};
}

calib::Observation observation_from(const json& j) {
  calib::Observation s;
  s.name = j.at("name");
  s.time_s = j.at("time_s");
  s.edge_width_px = j.at("edge_width_px");
  s.foreign_ids = j.at("foreign_ids").get<std::vector<int>>();
  s.points = j.at("points").get<std::vector<int>>();
  for (const json& p : j.at("px")) s.px.emplace_back(p.at(0).get<double>(), p.at(1).get<double>());
  return s;
}

}  // namespace

CornersCache::CornersCache(const std::filesystem::path& file, const std::string& board_text)
    : file_(file), board_text_(board_text) {
  std::error_code error;
  if (file_.empty() || !std::filesystem::exists(file_, error)) return;
  try {
    std::ifstream in(file_);
    const json content = json::parse(in);
    if (content.at("skyshaft_corners") != 1) throw std::runtime_error("another version");
    if (content.at("board") != board_text_) return;
    for (const json& entry : content.at("inputs")) {
      if (entry.at("stamp") == stamp_of(entry.at("input"))) entries_[entry.at("input")] = entry.dump();
    }
  } catch (const std::exception&) {
    throw ar::InputError(fmt::format("{}: is no cache of corners\ngive --corners-cache another name", file_.string()));
  }
}

std::optional<LookedAt> CornersCache::find(const std::string& input) const {
  const auto entry = entries_.find(input);
  if (entry == entries_.end()) return std::nullopt;
  const json j = json::parse(entry->second);
  LookedAt looked{input, j.at("width"), j.at("height"), j.at("video"), {}};
  for (const json& frame : j.at("frames")) looked.frames.push_back(observation_from(frame));
  return looked;
}

void CornersCache::keep(const LookedAt& looked) {
  if (file_.empty()) return;
  json frames = json::array();
  for (const calib::Observation& s : looked.frames) frames.push_back(to_json(s));
  const json entry{{"input", looked.input},   {"stamp", stamp_of(looked.input)}, {"width", looked.width},
                   {"height", looked.height}, {"video", looked.video},           {"frames", frames}};
  entries_[looked.input] = entry.dump();
  changed_ = true;
}

void CornersCache::save() const {
  if (!changed_) return;
  std::string inputs;
  for (const auto& [input, entry] : entries_) inputs += (inputs.empty() ? "" : ",\n") + entry;
  write_whole(file_,
              fmt::format("{{\"skyshaft_corners\": 1, \"board\": {}, \"inputs\": [\n{}\n]}}\n",
                          json(board_text_).dump(), inputs),
              true);
}

}  // namespace app
