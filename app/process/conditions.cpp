#include "app/process/conditions.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <stdexcept>

#include "app/error.h"

namespace app {
namespace {

// Runs a reader of a command line value and names the option in what it throws.
template <typename Reader>
auto read_option(const char* option, Reader&& reader) {
  try {
    return reader();
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{}: {}", option, error.what()));
  }
}

void resolve_place(const std::optional<std::string>& at, const SceneFile& scene, const ar::RecordedAt& recorded,
                   Conditions& conditions) {
  if (at) {
    conditions.place = read_option("--at", [&] { return ar::parse_position(*at); });
    conditions.place_origin = "the command line";
  } else if (scene.place) {
    conditions.place = scene.place;
    conditions.place_origin = scene.path.string();
  } else if (recorded.latitude_deg && recorded.longitude_deg) {
    conditions.place = {*recorded.latitude_deg, *recorded.longitude_deg, recorded.height_m.value_or(0.0)};
    conditions.place_origin = "the video's metadata";
  }
}

void resolve_time(const std::optional<std::string>& time, const SceneFile& scene, const ar::RecordedAt& recorded,
                  Conditions& conditions) {
  if (time) {
    conditions.time = read_option("--time", [&] { return ar::parse_time(*time); });
    conditions.time_origin = "the command line";
  } else if (scene.time) {
    conditions.time = scene.time;
    conditions.time_origin = scene.path.string();
  } else if (recorded.time) {
    conditions.time = recorded.time;
    conditions.time_origin = "the video's metadata";
  }
}

}  // namespace

Conditions resolve_conditions(const std::optional<std::string>& at, const std::optional<std::string>& time,
                              const SceneFile& scene, const ar::RecordedAt& recorded) {
  Conditions conditions;
  resolve_place(at, scene, recorded, conditions);
  resolve_time(time, scene, recorded, conditions);
  return conditions;
}

void log_conditions(const Conditions& conditions) {
  if (conditions.place) {
    const ar::GeoPosition& place = *conditions.place;
    spdlog::info("place {:.6g} {} {:.6g} {}, height {:.6g} m, from {}", std::abs(place.latitude_deg),
                 place.latitude_deg < 0.0 ? 'S' : 'N', std::abs(place.longitude_deg),
                 place.longitude_deg < 0.0 ? 'W' : 'E', place.height_m, conditions.place_origin);
  }
  if (conditions.time) spdlog::info("time {}, from {}", ar::format_time(*conditions.time), conditions.time_origin);
}

}  // namespace app
