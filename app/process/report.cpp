#include "app/process/report.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>
#include <span>

#include "render/base/whole_file.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

Json frames_json(const FrameCounts& frames) {
  return {{"total", frames.total()},
          {"tracking", frames.tracking},
          {"predicted", frames.predicted},
          {"lost", frames.lost},
          {"untouched", frames.untouched}};
}

Json stages_json(const std::vector<StageTime>& stages) {
  Json list = Json::array();
  for (const StageTime& stage : stages) {
    list.push_back({{"name", stage.name}, {"median_ms", stage.median_ms()}, {"busy_s", stage.busy_s()}});
  }
  return list;
}

Json passes_json(const RunFacts& facts) {
  Json list = Json::array();
  for (const auto& [name, median_ms] : facts.median_pass_ms) {
    list.push_back({{"name", name}, {"median_ms", median_ms}});
  }
  return list;
}

Json plan_json(const render::Plan& plan) {
  Json list = Json::array();
  for (const render::Pass& pass : plan.passes) {
    list.push_back({{"name", pass.feature->name}, {"settings", pass.settings}, {"reason", pass.reason}});
  }
  return list;
}

const char* name_of(ar::VideoCodec codec) {
  switch (codec) {
    case ar::VideoCodec::H264:
      return "h264";
    case ar::VideoCodec::Hevc:
      return "hevc";
    case ar::VideoCodec::Ffv1:
      return "ffv1";
  }
  return "";
}

Json settings_json(const ProcessOptions& options, const RunFacts& facts) {
  return {{"codec", name_of(options.sink.codec)},
          {"crf", options.sink.crf},
          {"preset", options.sink.preset},
          {"shafts", render::to_text(facts.plan.quality.shafts)},
          {"shadow_map_size", facts.plan.quality.shadow_map_size},
          {"exposure", facts.exposure},
          {"exposure_from", facts.exposure_origin}};
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace

void FrameCounts::add(ar::TrackState state) {
  switch (state) {
    case ar::TrackState::Tracking:
      ++tracking;
      break;
    case ar::TrackState::Predicted:
      ++predicted;
      break;
    case ar::TrackState::Lost:
      ++lost;
      break;
  }
}

void write_report(const std::filesystem::path& path, const ProcessOptions& options, const ar::SourceInfo& source,
                  const RunFacts& facts) {
  const double rate = facts.wall_s > 0.0 ? static_cast<double>(facts.frames.total()) / facts.wall_s : 0.0;
  const Json report = {{"input", options.input},
                       {"output", options.output.string()},
                       {"scene", options.scene.string()},
                       {"width", source.format.width},
                       {"height", source.format.height},
                       {"frames", frames_json(facts.frames)},
                       {"interrupted", facts.interrupted},
                       {"wall_s", facts.wall_s},
                       {"frames_per_second", rate},
                       {"renderer", facts.renderer},
                       {"peak_memory_mib", peak_memory_mib()},
                       {"settings", settings_json(options, facts)},
                       {"stages", stages_json(facts.stages)},
                       {"passes", passes_json(facts)},
                       {"plan", plan_json(facts.plan)}};
  const std::string text = report.dump(2) + "\n";
  render::write_file_whole(path, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace app
