#include "app/live/live_report.h"

#include <nlohmann/json.hpp>

#include "app/process/output_files.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

Json times_json(const Distribution& times) {
  return {{"median", times.percentile_ms(0.5)}, {"p90", times.percentile_ms(0.9)}, {"p99", times.percentile_ms(0.99)},
          {"max", times.largest_ms()},          {"mean", times.mean_ms()},         {"frames", times.count()}};
}

Json frames_json(const LiveFacts& facts) {
  return {{"captured", facts.feed.captured},
          {"presented", facts.presented},
          {"dropped", facts.dropped()},
          {"dropped_before_tracking", facts.feed.stale},
          {"dropped_before_drawing", facts.stale_tracked},
          {"missed_by_the_camera", facts.feed.missed},
          {"damaged", facts.feed.damaged},
          {"tracking", facts.tracked.tracking},
          {"predicted", facts.tracked.predicted},
          {"lost", facts.tracked.lost},
          {"recorded", facts.recorded},
          {"left_out_of_recording", facts.left_out}};
}

Json quality_json(const DrawStage& drawing) {
  const render::Quality& quality = drawing.quality();
  return {{"level", drawing.governor().level()},
          {"changes", drawing.governor().changes()},
          {"target_ms", drawing.governor().target_ms()},
          {"render_scale", quality.render_scale},
          {"anti_alias", quality.anti_alias},
          {"shafts", render::to_text(drawing.renderer().last_plan().quality.shafts)}};
}

}  // namespace

double LiveFacts::per_second() const {
  return wall_s > 0.0 ? static_cast<double>(presented - 1) / wall_s : 0.0;
}

void write_live_report(const std::filesystem::path& path, const ar::SourceInfo& source, const LiveFacts& facts,
                       const DrawStage& drawing) {
  Json passes = Json::array();
  const auto cpu_ms = drawing.renderer().median_pass_cpu_ms();
  for (const auto& [name, median_ms] : drawing.renderer().median_pass_ms()) {
    passes.push_back({{"name", name}, {"median_ms", median_ms}, {"median_cpu_ms", cpu_ms.at(passes.size()).second}});
  }
  const LiveTimes& times = facts.times;
  const Json report = {
      {"source", source.name},
      {"width", source.format.width},
      {"height", source.format.height},
      {"frames", frames_json(facts)},
      {"presented_per_second", facts.per_second()},
      {"wall_s", facts.wall_s},
      {"interrupted", facts.interrupted},
      {"losses", facts.feed.losses},
      {"reconnections", facts.feed.reconnections},
      {"latency_ms", times_json(times.latency)},
      {"pipeline_latency_ms", times_json(times.pipeline)},
      {"interval_ms", times_json(times.interval)},
      {"stages_ms",
       {{"track", times_json(times.track)}, {"draw", times_json(times.draw)}, {"present", times_json(times.present)}}},
      {"quality", quality_json(drawing)},
      {"passes", passes},
      {"exposure", drawing.exposure().exposure},
      {"exposure_from", drawing.exposure().origin},
      {"renderer", drawing.renderer().renderer_name()}};
  write_whole(path, report.dump(2) + "\n", true);
}

}  // namespace app
