#include "ar/capture/live/camera_controls.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "ar/error.h"
#include "render/base/number.h"

namespace ar {
namespace {

std::string describe(const ControlSetting& setting) {
  switch (setting.mode) {
    case ControlSetting::Mode::Automatic:
      return "let " + name_of(setting.control) + " be automatic";
    case ControlSetting::Mode::Locked:
      return "lock " + name_of(setting.control);
    case ControlSetting::Mode::Value:
      break;
  }
  return "set " + name_of(setting.control);
}

bool apply(const ControlSetting& setting, CameraControls& controls) {
  if (setting.mode == ControlSetting::Mode::Value) return controls.set(setting.control, setting.value);
  return controls.set_automatic(setting.control, setting.mode == ControlSetting::Mode::Automatic);
}

// "exposure 0.0001 to 0.5 s or auto, gain 0 to 100"
std::string offered(const CameraControls& controls) {
  std::vector<std::string> texts;
  for (const CameraControl control : kCameraControls) {
    const auto state = controls.read(control);
    if (!state) continue;
    const char* unit = control == CameraControl::Exposure ? " s" : control == CameraControl::WhiteBalance ? " K" : "";
    texts.push_back(fmt::format("{} {:g} to {:g}{}{}", name_of(control), state->minimum, state->maximum, unit,
                                state->can_be_automatic ? " or auto" : ""));
  }
  return texts.empty() ? "none of exposure, gain, focus and white balance" : fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

std::string name_of(CameraControl control) {
  switch (control) {
    case CameraControl::Exposure:
      return "exposure";
    case CameraControl::Gain:
      return "gain";
    case CameraControl::Focus:
      return "focus";
    case CameraControl::WhiteBalance:
      break;
  }
  return "white-balance";
}

ControlSetting parse_control_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string value = equals == std::string::npos ? "" : text.substr(equals + 1);
  ControlSetting setting;
  bool known = false;
  for (const CameraControl control : kCameraControls) {
    if (name_of(control) != name) continue;
    setting.control = control;
    known = true;
  }
  const std::optional<double> number = render::parse_number(value);
  if (value == "lock") setting.mode = ControlSetting::Mode::Locked;
  if (number) setting.mode = ControlSetting::Mode::Value;
  if (number) setting.value = *number;
  if (known && (value == "auto" || value == "lock" || number)) return setting;
  throw std::invalid_argument(fmt::format(
      "'{}' is no camera setting; give exposure=SECONDS, gain=NUMBER, focus=NUMBER or white-balance=KELVIN, or auto or "
      "lock in place of the number",
      text));
}

void apply(const std::vector<ControlSetting>& settings, CameraControls& controls, const std::string& camera) {
  for (const ControlSetting& setting : settings) {
    if (apply(setting, controls)) continue;
    throw InputError(fmt::format("cannot {} of {}: it has no such control\nIt has {}.", describe(setting), camera,
                                 offered(controls)));
  }
}

}  // namespace ar
