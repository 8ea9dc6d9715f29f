#include "app/options/sky.h"

#include <CLI/CLI.hpp>
#include <map>
#include <numbers>

#include "app/options/words.h"
#include "ar/place/place.h"
#include "render/sky/clouds.h"
#include "render/sky/sky_models.h"

namespace app {

void add_place_time_options(CLI::App& command, PlaceTimeArguments& arguments) {
  command.add_option("--at", arguments.at, "Place: LAT,LON[,HEIGHT] in degrees (north and east positive) and metres");
  command.add_option("--time", arguments.time, "Instant: 2024-06-21T07:30:00Z, or with an offset, +02:00");
}

void add_turbidity_option(CLI::App& command, double& turbidity) {
  command.add_option("--turbidity", turbidity, "Haziness (Linke): 2 very clear, 2.45 clear, 4 hazy, 6 thick haze")
      ->check(CLI::Range(1.0, 64.0))
      ->capture_default_str();
}

void add_model_options(CLI::App& command, SkyModelArguments& arguments) {
  command.add_option("--model", arguments.sky.model, render::known_sky_models())->capture_default_str();
  command
      .add_option("--bins", arguments.sky.bins,
                  "Perez coefficients: interpolated between the clearness bins, or original")
      ->transform(CLI::CheckedTransformer(std::map<std::string, render::PerezBins>{
          {"interpolated", render::PerezBins::Interpolated}, {"original", render::PerezBins::Original}}))
      ->default_str("interpolated");
  command.add_option("--irradiance", arguments.irradiance, "Perez: measured DNI,DHI in W/m2 instead of a turbidity")
      ->delimiter(',')
      ->expected(2);
  command.add_option("--condition", arguments.condition, "Perez: clearness EPSILON and brightness DELTA instead")
      ->delimiter(',')
      ->expected(2);
  command.add_option("--clouds", arguments.sky.clouds.preset, join_or(render::cloud_preset_names()))
      ->capture_default_str();
  command.add_option("--seed", arguments.sky.clouds.seed, "Another number, other clouds")->capture_default_str();
}

render::Place place_of(const std::string& at) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const ar::GeoPosition position = ar::parse_position(at);
  return {position.latitude_deg * kRadPerDeg, position.longitude_deg * kRadPerDeg, position.height_m};
}

render::SkyOptions options_of(const SkyModelArguments& arguments) {
  render::SkyOptions sky = arguments.sky;
  if (!arguments.irradiance.empty()) sky.irradiance = {arguments.irradiance[0], arguments.irradiance[1]};
  if (!arguments.condition.empty()) sky.condition = {arguments.condition[0], arguments.condition[1]};
  return sky;
}

}  // namespace app
