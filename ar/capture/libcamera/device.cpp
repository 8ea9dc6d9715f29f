#include "ar/capture/libcamera/device.h"

#include <fmt/format.h>
#include <libcamera/logging.h>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "ar/capture/live/camera_format.h"
#include "ar/error.h"

namespace ar::lc {
namespace {

namespace formats = libcamera::formats;

constexpr unsigned kBuffers = 4;

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

std::shared_ptr<libcamera::Camera> find_camera(libcamera::CameraManager& manager, const std::string& id) {
  const auto cameras = manager.cameras();
  if (cameras.empty()) {
    throw InputError(
        "libcamera finds no camera\nPlug one in, see that you may use it (group video), or try --source v4l2:.");
  }
  if (id.empty()) return cameras.front();
  if (auto camera = manager.get(id)) return camera;
  throw InputError(
      fmt::format("libcamera knows no camera {}\nPlug it in; `skyshaft live --list-cameras` lists what is here.", id));
}

void refuse(const libcamera::Camera& camera, const std::string& what, int error) {
  if (error == -EBUSY) {
    throw InputError(fmt::format("cannot use {}: another program is using it\nClose that program.", camera.id()));
  }
  throw InputError(fmt::format("cannot use {}: {}: {}\nPlug it in again, or try --source v4l2:.", camera.id(), what,
                               std::strerror(-error)));
}

std::string name_of(const libcamera::Camera& camera) {
  return camera.properties().get(libcamera::properties::Model).value_or(camera.id());
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

std::unique_ptr<libcamera::CameraConfiguration> configure(libcamera::Camera& camera, const LiveRequest& request) {
  auto configuration = camera.generateConfiguration({libcamera::StreamRole::Viewfinder});
  if (!configuration || configuration->empty()) refuse(camera, "no stream to view", -ENODEV);
  libcamera::StreamConfiguration& stream = configuration->at(0);
  const auto choice = choose_mode(modes_of(stream), request);
  if (!choice) {
    throw InputError(fmt::format("cannot use {}: it does not offer {}\nAsk for another format, or none.", camera.id(),
                                 request.format ? *request.format : "a format that can be decoded here"));
  }
  for (const libcamera::PixelFormat& format : stream.formats().pixelformats()) {
    if (v4l2_name(format) == choice->mode.format) stream.pixelFormat = format;
  }
  // Of sizes that change in steps libcamera lists a few, but takes more.
  const bool sized = request.width && request.height;
  stream.size = {static_cast<unsigned>(sized ? *request.width : choice->mode.width),
                 static_cast<unsigned>(sized ? *request.height : choice->mode.height)};
  stream.bufferCount = kBuffers;
  if (configuration->validate() == libcamera::CameraConfiguration::Invalid) {
    refuse(camera, "no valid configuration", -EINVAL);
  }
  if (!find_camera_format(v4l2_name(stream.pixelFormat))) {
    refuse(camera, "its format " + stream.pixelFormat.toString() + " cannot be decoded", -EINVAL);
  }
  if (const int error = camera.configure(configuration.get()); error != 0) refuse(camera, "configure", error);
  return configuration;
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
