#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ar/capture/live/live_source.h"

namespace ar {

// One way in which a camera offers its pictures.
struct CameraMode {
  std::string format;  // FourCC as the driver writes it: "YUYV", "MJPG"
  int width = 0;
  int height = 0;
  std::vector<double> rates;     // frames a second, fastest first; empty: the camera does not say
  bool rates_are_range = false;  // every rate from rates.back() to rates.front(), not only those
  bool operator==(const CameraMode&) const = default;
};

// A camera that is plugged in.
struct CameraListing {
  std::string source;             // what open_live_source() takes: "v4l2:/dev/video0", "libcamera:..."
  std::string name;               // "Integrated Camera"
  std::vector<CameraMode> modes;  // all that it offers, formats that cannot be decoded too
  std::string problem;            // why it cannot be used, and what to do; empty where it can
};

struct ModeChoice {
  CameraMode mode;
  double rate = 0.0;  // frames a second to ask the camera for
};

// What is wanted where a request leaves it open.
inline constexpr int kUsualWidth = 1280;
inline constexpr int kUsualHeight = 720;
inline constexpr double kUsualRate = 30.0;

// The mode that serves the request best, among formats that can be decoded and, where the request names one, of that
// format. A size that was asked for comes before the rate; otherwise the rate comes first, then the size nearest to
// 1280x720. Among equals the format that costs least to read and loses no colour; MJPEG therefore only where no raw
// format reaches the rate, grey only where there is nothing else. Nothing where no mode is left.
std::optional<ModeChoice> choose_mode(const std::vector<CameraMode>& modes, const LiveRequest& request);

// "YUYV 640x480 at 30, 15": for lists and messages.
std::string describe(const CameraMode& mode);

}  // namespace ar
