#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace ar {

enum class CameraControl { Exposure, Gain, Focus, WhiteBalance };

inline constexpr std::array kCameraControls{CameraControl::Exposure, CameraControl::Gain, CameraControl::Focus,
                                            CameraControl::WhiteBalance};

// "exposure", "gain", "focus", "white-balance".
std::string name_of(CameraControl control);

// Exposure in seconds, white balance in kelvin; gain and focus in whatever unit the camera has.
struct ControlState {
  double value = 0.0;
  double minimum = 0.0;
  double maximum = 0.0;
  double step = 0.0;  // 0: continuous
  bool can_be_automatic = false;
  bool automatic = false;  // then `value` is what it was when last the camera told
};

// What is wanted of a control.
struct ControlSetting {
  enum class Mode { Automatic, Locked, Value };
  CameraControl control = CameraControl::Exposure;
  Mode mode = Mode::Automatic;
  double value = 0.0;  // of Mode::Value
  bool operator==(const ControlSetting&) const = default;
};

// "exposure=0.01", "gain=lock" (stays as it is now), "white-balance=auto". Throws std::invalid_argument that says what
// would be accepted.
ControlSetting parse_control_setting(const std::string& text);

// The controls of an open camera. Of a camera that is gone they throw InputError.
class CameraControls {
 public:
  virtual ~CameraControls() = default;
  // Nothing where the camera has no such control.
  virtual std::optional<ControlState> read(CameraControl control) const = 0;
  // Sets it by hand, to the nearest value that the camera can; true where it has the control.
  virtual bool set(CameraControl control, double value) = 0;
  // Lets the camera decide, or holds the value it has now; true where the camera can do that.
  virtual bool set_automatic(CameraControl control, bool automatic) = 0;
};

// Throws InputError, naming the camera, where it cannot do one of them; those before it are done.
void apply(const std::vector<ControlSetting>& settings, CameraControls& controls, const std::string& camera);

}  // namespace ar
