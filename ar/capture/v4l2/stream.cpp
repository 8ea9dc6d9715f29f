#include "ar/capture/v4l2/stream.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <set>

#include "ar/capture/live/camera_format.h"
#include "ar/error.h"

namespace ar::v4l2 {
namespace {

std::string offered_formats(const std::vector<CameraMode>& modes) {
  std::set<std::string> names;
  for (const CameraMode& mode : modes) names.insert(mode.format);
  return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
}

// As many drivers describe a picture of one plane of memory, whatever its number.
v4l2_pix_format as_single(const v4l2_pix_format_mplane& planes) {
  v4l2_pix_format picture{};
  picture.width = planes.width;
  picture.height = planes.height;
  picture.pixelformat = planes.pixelformat;
  picture.field = planes.field;
  picture.bytesperline = planes.plane_fmt[0].bytesperline;
  picture.colorspace = planes.colorspace;
  picture.ycbcr_enc = planes.ycbcr_enc;
  picture.quantization = planes.quantization;
  picture.xfer_func = planes.xfer_func;
  return picture;
}

// Asks for size and format; what the driver made of them.
StreamFormat negotiate(const v4l2::Device& device, const CameraMode& mode) {
  v4l2_format format{};
  format.type = device.capture_type();
  const bool several = V4L2_TYPE_IS_MULTIPLANAR(format.type);
  const auto width = static_cast<std::uint32_t>(mode.width);
  const auto height = static_cast<std::uint32_t>(mode.height);
  if (several) {
    format.fmt.pix_mp.width = width;
    format.fmt.pix_mp.height = height;
    format.fmt.pix_mp.pixelformat = fourcc_code(mode.format);
    format.fmt.pix_mp.field = V4L2_FIELD_NONE;
  } else {
    format.fmt.pix.width = width;
    format.fmt.pix.height = height;
    format.fmt.pix.pixelformat = fourcc_code(mode.format);
    format.fmt.pix.field = V4L2_FIELD_NONE;
  }
  device.require(VIDIOC_S_FMT, &format, "VIDIOC_S_FMT");
  if (!several) return {format.fmt.pix, {static_cast<int>(format.fmt.pix.bytesperline)}};
  const v4l2_pix_format_mplane& planes = format.fmt.pix_mp;
  StreamFormat stream{as_single(planes), {}};
  for (int i = 0; i < planes.num_planes; ++i) {
    stream.strides_bytes.push_back(static_cast<int>(planes.plane_fmt[i].bytesperline));
  }
  return stream;
}

}  // namespace

ModeChoice choose(const v4l2::Device& device, const LiveRequest& request) {
  if (!device.captures()) {
    throw InputError(fmt::format(
        "cannot use {} ({}): it gives no pictures to programs\nIt may be an output, hold metadata only, or be part of "
        "a camera that libcamera drives; `skyshaft live --list-cameras` lists those that can be used.",
        device.node().string(), device.card()));
  }
  const std::vector<CameraMode> modes = v4l2::list_modes(device, request);
  if (const auto choice = choose_mode(modes, request)) return *choice;
  throw InputError(
      fmt::format("cannot use {} ({}): it offers {}, not {}\nAsk for one of these, or none: YU12, NV12, "
                  "YUYV, UYVY, RGB3, BGR3, MJPG, GREY.",
                  device.node().string(), device.card(), offered_formats(modes),
                  request.format ? *request.format : "a format that can be decoded here"));
}

StreamFormat set_format(const v4l2::Device& device, const CameraMode& mode) {
  const StreamFormat stream = negotiate(device, mode);
  const v4l2_pix_format& set = stream.picture;
  if (set.pixelformat != fourcc_code(mode.format)) {
    throw InputError(fmt::format("cannot use {} ({}): asked for {}, it gives {}\nAsk for another format or size.",
                                 device.node().string(), device.card(), mode.format, fourcc_name(set.pixelformat)));
  }
  const bool whole = set.field == V4L2_FIELD_NONE || set.field == V4L2_FIELD_ANY;
  const bool woven = set.field == V4L2_FIELD_INTERLACED || set.field == V4L2_FIELD_INTERLACED_TB ||
                     set.field == V4L2_FIELD_INTERLACED_BT;
  if (!whole && !woven) {
    throw InputError(
        fmt::format("cannot use {} ({}): it gives half-pictures (interlaced fields)\nSet its input to a "
                    "progressive one (v4l2-ctl).",
                    device.node().string(), device.card()));
  }
  if (woven) spdlog::warn("{}: interlaced; its frames are combed where things move", device.node().string());
  return stream;
}

Rational set_rate(const v4l2::Device& device, double rate) {
  v4l2_streamparm parameters{};
  parameters.type = device.capture_type();
  if (device.call(VIDIOC_G_PARM, &parameters) != 0) return {0, 1};
  v4l2_captureparm& capture = parameters.parm.capture;
  if ((capture.capability & V4L2_CAP_TIMEPERFRAME) != 0) {
    constexpr std::uint32_t kFine = 10'000'000;  // UVC counts in 100 ns
    capture.timeperframe = {static_cast<std::uint32_t>(std::lround(kFine / rate)), kFine};
    if (const int error = device.call(VIDIOC_S_PARM, &parameters); error != 0) {
      throw InputError(v4l2::explain(device.node(), "VIDIOC_S_PARM", error));
    }
  }
  const v4l2_fract& interval = capture.timeperframe;
  if (interval.numerator == 0 || interval.denominator == 0) return {0, 1};
  int num = 0;
  int den = 1;
  av_reduce(&num, &den, interval.denominator, interval.numerator, 1'000'000);
  return {num, den};
}

}  // namespace ar::v4l2
