#pragma once

#include <string>
#include <vector>

#include "render/sky/sky_model.h"
#include "render/sun/sun.h"

namespace CLI {
class App;
}

namespace app {

// Options that the commands about sun and sky share, as they come from the command line.
struct PlaceTimeArguments {
  std::string at;
  std::string time;
};
struct SkyModelArguments {
  render::SkyOptions sky;
  std::vector<double> irradiance;
  std::vector<double> condition;
};

void add_place_time_options(CLI::App& command, PlaceTimeArguments& arguments);
void add_turbidity_option(CLI::App& command, double& turbidity);
// Everything that shapes a sky but the turbidity.
void add_model_options(CLI::App& command, SkyModelArguments& arguments);

// LAT,LON[,HEIGHT] in degrees and metres. Throws std::invalid_argument.
render::Place place_of(const std::string& at);
render::SkyOptions options_of(const SkyModelArguments& arguments);

}  // namespace app
