#include <cmath>
#include <string>
#include <vector>

#include "render/sky/sky_condition.h"
#include "render/sky/sky_models.h"

namespace render {
namespace {

std::string decimal(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

void check_turbidity(const SkyOptions& options, std::vector<std::string>& found) {
  const SkyModelInfo* model = find_sky_model(options.model);
  if (model == nullptr || !model->turbidity) return;
  const TurbidityLimits& limits = *model->turbidity;
  if (options.turbidity < limits.least || options.turbidity > limits.most) {
    found.push_back("turbidity is outside what sky `" + options.model + "` knows: held in " + decimal(limits.least) +
                    " to " + decimal(limits.most));
  }
}

void check_condition(const SkyOptions& options, const SunPosition& sun, std::vector<std::string>& found) {
  if (options.irradiance && (options.irradiance->dni_wm2 < 0.0 || options.irradiance->dhi_wm2 < 0.0)) {
    found.emplace_back("negative irradiance counts as 0");
  }
  if (options.condition && (options.condition->clearness < 1.0 || options.condition->clearness > 12.0)) {
    found.emplace_back("clearness is outside 1 to 12: held there");
  }
  const Day day = day_of(sun);
  const Condition condition = condition_of(options, day);
  const double held = held_brightness(condition.clearness, condition.brightness, day.zenith_rad);
  if (std::abs(held - condition.brightness) > 1e-9) {
    found.emplace_back(
        "brightness is outside what the Perez coefficients are valid for with that clearness and sun: "
        "the nearest valid one shapes the sky");
  }
}

}  // namespace

std::vector<std::string> beyond_range(const SkyOptions& options, const SunPosition& sun) {
  std::vector<std::string> found;
  const bool given = options.model == "perez" && (options.condition || options.irradiance);
  if (given) {
    check_condition(options, sun, found);
  } else {
    check_turbidity(options, found);
  }
  return found;
}

}  // namespace render
