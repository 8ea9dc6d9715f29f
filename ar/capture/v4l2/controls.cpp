#include "ar/capture/v4l2/controls.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "ar/error.h"

namespace ar::v4l2 {
namespace {

// Where a control lives: its value, in units of `unit`, and what makes it automatic (0: nothing).
struct Place {
  std::uint32_t value;
  double unit;
  std::uint32_t automatic;
};

Place place_of(CameraControl control) {
  switch (control) {
    case CameraControl::Exposure:
      return {V4L2_CID_EXPOSURE_ABSOLUTE, 1e-4, V4L2_CID_EXPOSURE_AUTO};
    case CameraControl::Gain:
      return {V4L2_CID_GAIN, 1.0, V4L2_CID_AUTOGAIN};
    case CameraControl::Focus:
      return {V4L2_CID_FOCUS_ABSOLUTE, 1.0, V4L2_CID_FOCUS_AUTO};
    case CameraControl::WhiteBalance:
      break;
  }
  return {V4L2_CID_WHITE_BALANCE_TEMPERATURE, 1.0, V4L2_CID_AUTO_WHITE_BALANCE};
}

bool query(const Device& device, std::uint32_t id, v4l2_queryctrl& about) {
  about = {};
  about.id = id;
  return device.call(VIDIOC_QUERYCTRL, &about) == 0 && (about.flags & V4L2_CTRL_FLAG_DISABLED) == 0;
}

std::int32_t get(const Device& device, std::uint32_t id) {
  v4l2_control control{id, 0};
  device.require(VIDIOC_G_CTRL, &control, "VIDIOC_G_CTRL");
  return control.value;
}

void put(const Device& device, std::uint32_t id, std::int32_t value) {
  v4l2_control control{id, value};
  device.require(VIDIOC_S_CTRL, &control, "VIDIOC_S_CTRL");
}

bool offers(const Device& device, std::uint32_t id, std::uint32_t item) {
  v4l2_querymenu menu{};
  menu.id = id;
  menu.index = item;
  return device.call(VIDIOC_QUERYMENU, &menu) == 0;
}

// Exposure's modes are a menu: two that choose the time by themselves, two that do not. Others are a switch.
bool is_automatic(std::uint32_t id, std::int32_t value) {
  if (id == V4L2_CID_EXPOSURE_AUTO) return value == V4L2_EXPOSURE_AUTO || value == V4L2_EXPOSURE_APERTURE_PRIORITY;
  return value != 0;
}

std::optional<std::int32_t> value_for(const Device& device, std::uint32_t id, bool automatic) {
  if (id != V4L2_CID_EXPOSURE_AUTO) return automatic ? 1 : 0;
  const std::array modes = automatic ? std::array{V4L2_EXPOSURE_APERTURE_PRIORITY, V4L2_EXPOSURE_AUTO}
                                     : std::array{V4L2_EXPOSURE_MANUAL, V4L2_EXPOSURE_SHUTTER_PRIORITY};
  for (const auto mode : modes) {
    if (offers(device, id, static_cast<std::uint32_t>(mode))) return static_cast<std::int32_t>(mode);
  }
  return std::nullopt;
}

}  // namespace

Controls::Controls(std::shared_ptr<const Device> device) : device_(std::move(device)), fixed_exposure_s_(0.0) {
  note_exposure();
}

std::optional<ControlState> Controls::read(CameraControl control) const {
  const Place place = place_of(control);
  v4l2_queryctrl about;
  if (!query(*device_, place.value, about)) return std::nullopt;
  ControlState state;
  state.minimum = about.minimum * place.unit;
  state.maximum = about.maximum * place.unit;
  state.step = about.step * place.unit;
  state.value = get(*device_, place.value) * place.unit;
  v4l2_queryctrl automatic;
  if (query(*device_, place.automatic, automatic)) {
    state.can_be_automatic = value_for(*device_, place.automatic, true).has_value();
    state.automatic = is_automatic(place.automatic, get(*device_, place.automatic));
  }
  return state;
}

bool Controls::switch_automatic(CameraControl control, bool automatic) const {
  const Place place = place_of(control);
  v4l2_queryctrl about;
  if (!query(*device_, place.automatic, about)) return !automatic;  // what has no automatic is never automatic
  const auto value = value_for(*device_, place.automatic, automatic);
  if (!value) return false;
  put(*device_, place.automatic, *value);
  return true;
}

bool Controls::set(CameraControl control, double value) {
  const Place place = place_of(control);
  v4l2_queryctrl about;
  if (!query(*device_, place.value, about) || !switch_automatic(control, false)) return false;
  const double units =
      std::clamp(value / place.unit, static_cast<double>(about.minimum), static_cast<double>(about.maximum));
  const int step = std::max(1, about.step);
  const auto steps = static_cast<std::int32_t>(std::lround((units - about.minimum) / step));
  put(*device_, place.value, std::min(about.maximum, about.minimum + steps * step));
  note_exposure();
  return true;
}

bool Controls::set_automatic(CameraControl control, bool automatic) {
  const auto now = read(control);
  if (!now || (automatic && !now->can_be_automatic)) return false;
  // By hand a camera would go back to what was last set by hand, not stay at what it has found.
  if (!automatic) return set(control, now->value);
  const bool done = switch_automatic(control, true);
  note_exposure();
  return done;
}

void Controls::note_exposure() {
  fixed_exposure_s_ = 0.0;
  try {
    const auto state = read(CameraControl::Exposure);
    if (state && !state->automatic) fixed_exposure_s_ = state->value;
  } catch (const InputError&) {
    // Cameras there are that name a control and then do not tell it: they can be used all the same.
    return;
  }
}

std::optional<double> Controls::fixed_exposure_s() const {
  const double exposure_s = fixed_exposure_s_;
  if (exposure_s <= 0.0) return std::nullopt;
  return exposure_s;
}

}  // namespace ar::v4l2
