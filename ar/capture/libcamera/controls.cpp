#include "ar/capture/libcamera/controls.h"

#include <algorithm>
#include <cmath>

namespace ar::lc {
namespace {

namespace controls = libcamera::controls;

// libcamera's control for a value, and what one of its units is in ours.
struct Place {
  const libcamera::ControlId* value;
  double unit;
  bool whole;  // an integer
  const libcamera::ControlId* automatic;
};

Place place_of(CameraControl control) {
  switch (control) {
    case CameraControl::Exposure:
      return {&controls::ExposureTime, 1e-6, true, &controls::AeEnable};
    case CameraControl::Gain:
      return {&controls::AnalogueGain, 1.0, false, &controls::AeEnable};
    case CameraControl::Focus:
      return {&controls::LensPosition, 1.0, false, &controls::AfMode};
    case CameraControl::WhiteBalance:
      break;
  }
  return {&controls::ColourTemperature, 1.0, true, &controls::AwbEnable};
}

bool has(const libcamera::Camera& camera, const libcamera::ControlId* id) {
  return camera.controls().find(id) != camera.controls().end();
}

double number(const libcamera::ControlValue& value, bool whole) {
  return whole ? static_cast<double>(value.get<std::int32_t>()) : static_cast<double>(value.get<float>());
}

std::size_t index_of(CameraControl control) {
  return static_cast<std::size_t>(control);
}

}  // namespace

Controls::Controls(std::shared_ptr<libcamera::Camera> camera)
    : camera_(std::move(camera)), pending_(controls::controls) {
  automatic_.fill(true);  // as libcamera starts
}

std::optional<ControlState> Controls::read(CameraControl control) const {
  const std::lock_guard lock(mutex_);
  const Place place = place_of(control);
  const auto found = camera_->controls().find(place.value);
  if (found == camera_->controls().end()) return std::nullopt;
  ControlState state;
  state.minimum = number(found->second.min(), place.whole) * place.unit;
  state.maximum = number(found->second.max(), place.whole) * place.unit;
  state.step = place.whole ? place.unit : 0.0;
  state.can_be_automatic = has(*camera_, place.automatic);
  state.automatic = state.can_be_automatic && automatic_[index_of(control)];
  const double initial = number(found->second.def(), place.whole) * place.unit;
  state.value = value_[index_of(control)].value_or(initial);
  return state;
}

// With the lock held. Exposure and gain are one loop in libcamera.
bool Controls::switch_automatic(CameraControl control, bool automatic) {
  const Place place = place_of(control);
  if (!has(*camera_, place.automatic)) return !automatic;
  if (control == CameraControl::Focus) {
    pending_.set(controls::AfMode,
                 static_cast<std::int32_t>(automatic ? controls::AfModeContinuous : controls::AfModeManual));
  } else if (control == CameraControl::WhiteBalance) {
    pending_.set(controls::AwbEnable, automatic);
  } else {
    pending_.set(controls::AeEnable, automatic);
    automatic_[index_of(CameraControl::Exposure)] = automatic;
    automatic_[index_of(CameraControl::Gain)] = automatic;
  }
  automatic_[index_of(control)] = automatic;
  return true;
}

bool Controls::set(CameraControl control, double value) {
  const auto state = read(control);
  if (!state) return false;
  const std::lock_guard lock(mutex_);
  if (!switch_automatic(control, false)) return false;
  const Place place = place_of(control);
  const double clamped = std::clamp(value, state->minimum, state->maximum);
  libcamera::ControlValue wanted;
  if (place.whole) {
    wanted.set(static_cast<std::int32_t>(std::lround(clamped / place.unit)));
  } else {
    wanted.set(static_cast<float>(clamped));
  }
  pending_.set(place.value->id(), wanted);
  value_[index_of(control)] = clamped;
  return true;
}

bool Controls::set_automatic(CameraControl control, bool automatic) {
  const auto state = read(control);
  if (!state && control != CameraControl::WhiteBalance) return false;
  if (!automatic && state && value_[index_of(control)]) return set(control, state->value);
  const std::lock_guard lock(mutex_);
  // White balance can often be held, although not set.
  if (!has(*camera_, place_of(control).automatic)) return false;
  return switch_automatic(control, automatic);
}

libcamera::ControlList Controls::take() {
  const std::lock_guard lock(mutex_);
  libcamera::ControlList taken(controls::controls);
  std::swap(taken, pending_);
  return taken;
}

void Controls::note(const libcamera::ControlList& metadata) {
  const std::lock_guard lock(mutex_);
  for (const CameraControl control : kCameraControls) {
    const Place place = place_of(control);
    if (!metadata.contains(place.value->id())) continue;
    value_[index_of(control)] = number(metadata.get(place.value->id()), place.whole) * place.unit;
  }
}

}  // namespace ar::lc
