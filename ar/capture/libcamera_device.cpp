#include "ar/capture/libcamera_device.h"

#include <fmt/format.h>
#include <libcamera/logging.h>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <cstdlib>
#include <cstring>
#include <mutex>

#include "ar/capture/camera_format.h"
#include "ar/error.h"

namespace ar::lc {
namespace {

namespace formats = libcamera::formats;

struct Named {
  libcamera::PixelFormat format;
  const char* name;
};

// DRM's RGB888 is a little-endian number: its bytes lie in the order B, G, R.
constexpr Named kNamed[] = {{formats::YUV420, "YU12"}, {formats::NV12, "NV12"},   {formats::YUYV, "YUYV"},
                            {formats::UYVY, "UYVY"},   {formats::BGR888, "RGB3"}, {formats::RGB888, "BGR3"},
                            {formats::MJPEG, "MJPG"},  {formats::R8, "GREY"}};

}  // namespace

std::shared_ptr<libcamera::CameraManager> camera_manager() {
  static std::mutex mutex;
  static std::weak_ptr<libcamera::CameraManager> shared;
  const std::lock_guard lock(mutex);
  if (auto manager = shared.lock()) return manager;
  // Every failed call is reported by us; who asks libcamera itself to speak shall hear it.
  if (std::getenv("LIBCAMERA_LOG_LEVELS") == nullptr) libcamera::logSetTarget(libcamera::LoggingTargetNone);
  std::shared_ptr<libcamera::CameraManager> manager(new libcamera::CameraManager, [](libcamera::CameraManager* old) {
    old->stop();
    delete old;
  });
  if (const int error = manager->start(); error != 0) {
    throw InputError(
        fmt::format("cannot start libcamera: {}\nUse the camera through V4L2: --source v4l2:.", std::strerror(-error)));
  }
  shared = manager;
  return manager;
}

std::string v4l2_name(const libcamera::PixelFormat& format) {
  for (const Named& named : kNamed) {
    if (named.format == format) return named.name;
  }
  return {};
}

std::vector<CameraMode> modes_of(const libcamera::StreamConfiguration& stream) {
  std::vector<CameraMode> modes;
  for (const libcamera::PixelFormat& format : stream.formats().pixelformats()) {
    const std::string name = v4l2_name(format);
    if (name.empty()) continue;
    for (const libcamera::Size& size : stream.formats().sizes(format)) {
      modes.push_back({name, static_cast<int>(size.width), static_cast<int>(size.height), {}, false});
    }
  }
  return modes;
}

void tag_colors(const libcamera::ColorSpace& color, AVFrame& picture) {
  using libcamera::ColorSpace;
  const auto pixels = static_cast<AVPixelFormat>(picture.format);
  const bool rgb = (av_pix_fmt_desc_get(pixels)->flags & AV_PIX_FMT_FLAG_RGB) != 0;
  switch (color.primaries) {
    case ColorSpace::Primaries::Smpte170m:
      picture.color_primaries = AVCOL_PRI_SMPTE170M;
      break;
    case ColorSpace::Primaries::Rec709:
      picture.color_primaries = AVCOL_PRI_BT709;
      break;
    case ColorSpace::Primaries::Rec2020:
      picture.color_primaries = AVCOL_PRI_BT2020;
      break;
    default:
      break;
  }
  switch (color.transferFunction) {
    case ColorSpace::TransferFunction::Linear:
      picture.color_trc = AVCOL_TRC_LINEAR;
      break;
    case ColorSpace::TransferFunction::Srgb:
      picture.color_trc = AVCOL_TRC_IEC61966_2_1;
      break;
    case ColorSpace::TransferFunction::Rec709:
      picture.color_trc = AVCOL_TRC_BT709;
      break;
  }
  switch (color.ycbcrEncoding) {
    case ColorSpace::YcbcrEncoding::Rec601:
      picture.colorspace = AVCOL_SPC_SMPTE170M;
      break;
    case ColorSpace::YcbcrEncoding::Rec709:
      picture.colorspace = AVCOL_SPC_BT709;
      break;
    case ColorSpace::YcbcrEncoding::Rec2020:
      picture.colorspace = AVCOL_SPC_BT2020_NCL;
      break;
    default:
      break;
  }
  if (rgb) picture.colorspace = AVCOL_SPC_RGB;
  picture.color_range = color.range == ColorSpace::Range::Full || rgb ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
}

ExposureInfo exposure_of(const libcamera::ControlList& metadata) {
  namespace controls = libcamera::controls;
  ExposureInfo exposure;
  if (const auto time_us = metadata.get(controls::ExposureTime)) exposure.exposure_s = *time_us * 1e-6;
  if (const auto analogue = metadata.get(controls::AnalogueGain)) {
    exposure.gain = static_cast<double>(*analogue) * metadata.get(controls::DigitalGain).value_or(1.0F);
  }
  if (const auto kelvin = metadata.get(controls::ColourTemperature)) exposure.color_temperature_k = *kelvin;
  if (const auto lux = metadata.get(controls::Lux)) exposure.lux = *lux;
  return exposure;
}

}  // namespace ar::lc
