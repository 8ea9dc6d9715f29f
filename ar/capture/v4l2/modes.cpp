// What a V4L2 capture device offers: its formats, the sizes of each, the rates of each size.

#include <linux/videodev2.h>

#include <algorithm>

#include "ar/capture/live/camera_format.h"
#include "ar/capture/v4l2/device.h"

namespace ar::v4l2 {
namespace {

struct Size {
  int width;
  int height;
};

constexpr Size kUsualSizes[] = {{320, 240}, {640, 480}, {kUsualWidth, kUsualHeight}, {1920, 1080}, {3840, 2160}};

// Rates of frames from V4L2's durations; a duration of nothing is a rate of nothing.
void add_rate(const v4l2_fract& duration, std::vector<double>& rates) {
  if (duration.numerator > 0) rates.push_back(static_cast<double>(duration.denominator) / duration.numerator);
}

void add_rates(const Device& device, std::uint32_t format, CameraMode& mode) {
  v4l2_frmivalenum interval{};
  interval.pixel_format = format;
  interval.width = static_cast<std::uint32_t>(mode.width);
  interval.height = static_cast<std::uint32_t>(mode.height);
  for (; device.call(VIDIOC_ENUM_FRAMEINTERVALS, &interval) == 0; ++interval.index) {
    if (interval.type == V4L2_FRMIVAL_TYPE_DISCRETE) {
      add_rate(interval.discrete, mode.rates);
      continue;
    }
    add_rate(interval.stepwise.min, mode.rates);
    add_rate(interval.stepwise.max, mode.rates);
    mode.rates_are_range = true;
    break;
  }
  std::sort(mode.rates.rbegin(), mode.rates.rend());
  mode.rates.erase(std::unique(mode.rates.begin(), mode.rates.end()), mode.rates.end());
}

int on_step(int wanted, std::uint32_t least, std::uint32_t most, std::uint32_t step) {
  const int clamped = std::clamp(wanted, static_cast<int>(least), static_cast<int>(most));
  const int unit = std::max(1, static_cast<int>(step));
  return static_cast<int>(least) + (clamped - static_cast<int>(least)) / unit * unit;
}

std::vector<Size> sizes_of(const v4l2_frmsize_stepwise& range, const LiveRequest& request) {
  std::vector<Size> wanted(std::begin(kUsualSizes), std::end(kUsualSizes));
  if (request.width || request.height) {
    const int width = request.width ? *request.width : *request.height * 16 / 9;
    wanted.push_back({width, request.height.value_or(width * 9 / 16)});
  }
  std::vector<Size> sizes;
  for (const Size& size : wanted) {
    const Size offered{on_step(size.width, range.min_width, range.max_width, range.step_width),
                       on_step(size.height, range.min_height, range.max_height, range.step_height)};
    const bool known = std::any_of(sizes.begin(), sizes.end(), [&](const Size& other) {
      return other.width == offered.width && other.height == offered.height;
    });
    if (!known) sizes.push_back(offered);
  }
  return sizes;
}

std::vector<Size> list_sizes(const Device& device, std::uint32_t format, const LiveRequest& request) {
  std::vector<Size> sizes;
  v4l2_frmsizeenum size{};
  size.pixel_format = format;
  for (; device.call(VIDIOC_ENUM_FRAMESIZES, &size) == 0; ++size.index) {
    if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) return sizes_of(size.stepwise, request);
    sizes.push_back({static_cast<int>(size.discrete.width), static_cast<int>(size.discrete.height)});
  }
  if (!sizes.empty()) return sizes;
  // A driver that lists none has one, the present one (HDMI grabbers take their input's).
  v4l2_format current{};
  current.type = device.capture_type();
  // Width and height are the first members of both fmt.pix and fmt.pix_mp.
  if (device.call(VIDIOC_G_FMT, &current) == 0 && current.fmt.pix.width > 0) {
    sizes.push_back({static_cast<int>(current.fmt.pix.width), static_cast<int>(current.fmt.pix.height)});
  }
  return sizes;
}

}  // namespace

std::vector<CameraMode> list_modes(const Device& device, const LiveRequest& request) {
  std::vector<CameraMode> modes;
  v4l2_fmtdesc format{};
  format.type = device.capture_type();
  for (; device.call(VIDIOC_ENUM_FMT, &format) == 0; ++format.index) {
    for (const Size& size : list_sizes(device, format.pixelformat, request)) {
      CameraMode mode{fourcc_name(format.pixelformat), size.width, size.height, {}, false};
      add_rates(device, format.pixelformat, mode);
      modes.push_back(std::move(mode));
    }
  }
  return modes;
}

}  // namespace ar::v4l2
