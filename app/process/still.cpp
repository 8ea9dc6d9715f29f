#include "app/process/still.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>

#include "app/error.h"
#include "app/options/picture_size.h"
#include "app/options/shafts.h"
#include "app/process/conditions.h"
#include "app/process/scene_state_builder.h"
#include "ar/photometry/exposure.h"

namespace app {
void add_still_options(CLI::App& command, StillArguments& arguments) {
  command.add_option("-s,--scene", arguments.scene, "Scene file (YAML) with a `view`")->required();
  command.add_option("--at", arguments.at,
                     "LAT,LON[,HEIGHT]: degrees north, degrees east, metres; default: the scene's");
  command.add_option("--time", arguments.time, "2024-06-21T07:30:00Z or with an offset; default: the scene's");
  command.add_option("--size", arguments.size, "WIDTHxHEIGHT of the picture, pixels; default: 1280x720");
  command.add_option("--shafts", arguments.shafts, shafts_help());
  command
      .add_option(
          "--max-error", arguments.shaft_demand.max_error,
          "The cheapest setting of the shafts known to hold this relative RMSE of the in-scattered light, by the "
          "table measured on the standard scenes; default: the scene's quality.max_error")
      ->check(CLI::Range(1e-6, 1.0));
  command
      .add_option(
          "--target-ms", arguments.shaft_demand.target_ms,
          "The most accurate setting known to fit that time, milliseconds, by the same table; with --max-error: "
          "the cheapest that holds it and fits; default: the scene's quality.target_ms")
      ->check(CLI::PositiveNumber);
}

Still make_still(const StillArguments& arguments) {
  const auto [width, height] = parse_picture_size("--size", arguments.size);
  Still still{.scene = load_scene_file(arguments.scene), .state = {}};
  if (arguments.shaft_demand.max_error || arguments.shaft_demand.target_ms) {
    still.scene.quality.shafts = {};
    still.scene.quality.shaft_demand = arguments.shaft_demand;
  }
  if (!arguments.shafts.empty()) still.scene.quality.shafts = parse_shafts("--shafts", arguments.shafts);
  const Conditions conditions = resolve_conditions(arguments.at, arguments.time, still.scene, {});
  log_conditions(conditions);
  SceneStateBuilder builder(still.scene, conditions);
  still.state = builder.at(0.0);
  log_light(still.state);
  const double lux = horizontal_illuminance(still.state);
  if (!builder.exposure() && lux > 0.0) still.state.exposure = ar::exposure_from_mean(0.18, lux);
  still.state.camera.width = width;
  still.state.camera.height = height;
  if (still.scene.view) still.state.camera = camera_of_view(*still.scene.view, width, height);
  return still;
}

}  // namespace app
