#include "ar/capture/v4l2/source.h"

#include <fmt/format.h>
#include <poll.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cerrno>
#include <new>

#include "ar/capture/color/pixel_format.h"
#include "ar/capture/file/frame_maker.h"
#include "ar/capture/live/camera_format.h"
#include "ar/capture/live/dropped_frame_log.h"
#include "ar/capture/live/frame_clock.h"
#include "ar/capture/v4l2/buffers.h"
#include "ar/capture/v4l2/controls.h"
#include "ar/capture/v4l2/device.h"
#include "ar/capture/v4l2/mjpeg_decoder.h"
#include "ar/capture/v4l2/stream.h"
#include "ar/error.h"

namespace ar {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr unsigned kBuffers = 6;
constexpr unsigned kDriversShare = 2;        // so many buffers stay with the driver, whoever holds the others
constexpr milliseconds kFirstPicture{5000};  // a camera may take seconds to start

std::int64_t microseconds_now() {
  return std::chrono::duration_cast<std::chrono::microseconds>(steady_clock::now().time_since_epoch()).count();
}

class V4l2Source : public LiveSource {
 public:
  V4l2Source(const std::string& address, const LiveRequest& request);

  const SourceInfo& info() const override { return info_; }
  std::string identity() const override { return identity_; }
  LiveRead read(milliseconds patience) override;
  LiveCounts counts() const override { return dropped_frames_.counts(); }
  CameraControls* controls() override { return &controls_; }

 private:
  struct Taken {
    ffmpeg::FramePtr picture;  // null: the frame was damaged
    std::int64_t taken_us = 0;
  };

  void describe(const ModeChoice& choice);
  void await_first_picture();
  LiveRead lost(int error) const;
  LiveRead hand_out(Taken taken);
  int take(Taken& taken);
  bool find_planes(const v4l2::Filled& filled, AVFrame& picture) const;
  ffmpeg::FramePtr picture_in(const v4l2::Filled& filled);
  std::int64_t time_of(const v4l2_buffer& about);

  std::shared_ptr<const v4l2::Device> device_;
  v4l2::Controls controls_;
  std::string identity_;
  DroppedFrameLog dropped_frames_;
  PictureLayout layout_;  // of raw pictures
  v4l2::StreamFormat set_;
  std::optional<MjpegDecoder> decoder_;
  std::optional<FrameMaker> maker_;
  SourceInfo info_;
  double duration_s_ = 0.0;
  FrameClock clock_;
  bool foreign_notified_ = false;
  std::optional<v4l2::CaptureBuffers> buffers_;
  std::optional<Taken> first_;  // of a compressed stream: what told its format
  std::int64_t frames_ = 0;
};

V4l2Source::V4l2Source(const std::string& address, const LiveRequest& request)
    : device_(std::make_shared<const v4l2::Device>(v4l2::resolve(address))),
      controls_(device_),
      identity_("v4l2:" + v4l2::stable_address(*device_)),
      dropped_frames_(device_->node().string()) {
  const ModeChoice choice = v4l2::choose(*device_, request);
  set_ = v4l2::set_format(*device_, choice.mode);
  info_.frame_rate = v4l2::set_rate(*device_, choice.rate);
  apply(request.controls, controls_, device_->node().string());
  const CameraFormat format = *find_camera_format(choice.mode.format);
  const v4l2_pix_format& set = set_.picture;
  layout_ = {format.pixels, static_cast<int>(set.width), static_cast<int>(set.height),
             static_cast<int>(set.bytesperline)};
  if (format.codec != AV_CODEC_ID_NONE) decoder_.emplace();
  buffers_.emplace(device_, kBuffers);
  if (decoder_) {
    await_first_picture();
  } else {
    const ffmpeg::FramePtr like = ffmpeg::make_frame();
    like->format = layout_.pixels;
    like->width = layout_.width;
    like->height = layout_.height;
    tag_colors(set, *like);
    maker_.emplace(*like, nullptr, device_->node().string(), OpenOptions{.threads = 1});
  }
  describe(choice);
}

void V4l2Source::describe(const ModeChoice& choice) {
  maker_->describe(info_);
  info_.name = fmt::format("{} ({})", device_->card(), device_->node().string());
  info_.time_base = {1, 1'000'000};
  info_.codec = choice.mode.format;
  if (info_.frame_rate.num > 0) duration_s_ = static_cast<double>(info_.frame_rate.den) / info_.frame_rate.num;
  spdlog::info("{}: {} {}x{} at {:.4g} frames a second", info_.name, choice.mode.format, set_.picture.width,
               set_.picture.height, duration_s_ > 0 ? 1.0 / duration_s_ : 0.0);
}

// Only its first picture says how a compressed stream is sampled.
void V4l2Source::await_first_picture() {
  const auto end = steady_clock::now() + kFirstPicture;
  while (steady_clock::now() < end) {
    pollfd waiting{device_->descriptor(), POLLIN, 0};
    poll(&waiting, 1, 100);
    Taken taken;
    const int error = take(taken);
    if (error == EAGAIN) continue;
    if (error != 0) throw InputError(v4l2::explain(device_->node(), "VIDIOC_DQBUF", error));
    if (!taken.picture) continue;
    maker_.emplace(*taken.picture, nullptr, device_->node().string(), OpenOptions{.threads = 1});
    first_ = std::move(taken);
    return;
  }
  throw InputError(
      fmt::format("cannot use {} ({}): it gave no whole picture in {} s\nPlug it in again, or ask for "
                  "another format.",
                  device_->node().string(), device_->card(), kFirstPicture.count() / 1000));
}

std::int64_t V4l2Source::time_of(const v4l2_buffer& about) {
  DriverStamp stamp{about.sequence, std::nullopt};
  if ((about.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    stamp.taken_us = std::int64_t{about.timestamp.tv_sec} * 1'000'000 + about.timestamp.tv_usec;
  }
  const FrameClock::Reading reading = clock_.read(stamp, microseconds_now());
  dropped_frames_.missed(reading.missed);
  if (reading.foreign && !foreign_notified_) {
    spdlog::warn("{}: its driver's times are not of the system's clock; taken from their arrival",
                 dropped_frames_.name());
    foreign_notified_ = true;
  }
  return reading.taken_us;
}

// Points the picture at what was filled. False where that is too short.
bool V4l2Source::find_planes(const v4l2::Filled& filled, AVFrame& picture) const {
  if (filled.planes.size() == 1) {
    const std::ptrdiff_t offset = filled.planes[0].data() - filled.memory->data;
    for (std::uint8_t*& plane : picture.data) {
      if (plane != nullptr) plane += offset;
    }
    return filled.planes[0].size() >= layout_.bytes();
  }
  for (std::size_t i = 0; i < filled.planes.size(); ++i) {
    const int rows = i == 0 ? layout_.height : (layout_.height + 1) / 2;  // YM12 and NM12 are 4:2:0
    picture.data[i] = filled.planes[i].data();
    picture.linesize[i] = set_.strides_bytes.at(i);
    if (filled.planes[i].size() < static_cast<std::size_t>(rows) * static_cast<std::size_t>(picture.linesize[i])) {
      return false;
    }
  }
  return true;
}

ffmpeg::FramePtr V4l2Source::picture_in(const v4l2::Filled& filled) {
  const bool broken = (filled.about.flags & V4L2_BUF_FLAG_ERROR) != 0;
  if (broken) return nullptr;
  if (decoder_) return filled.planes[0].empty() ? nullptr : decoder_->decode(filled.planes[0]);
  ffmpeg::FramePtr picture = picture_on(layout_, filled.memory.get());
  if (!find_planes(filled, *picture)) return nullptr;
  tag_colors(set_.picture, *picture);
  // Pictures that need no conversion go out in the driver's own memory, until it would run dry.
  const bool dry = buffers_->on_loan() + kDriversShare > buffers_->count();
  if (dry && is_native(layout_.pixels) && av_frame_make_writable(picture.get()) < 0) throw std::bad_alloc();
  return picture;
}

// 0 and a frame, good or damaged; or the errno of the stream.
int V4l2Source::take(Taken& taken) {
  buffers_->retry();
  v4l2::Filled filled;
  if (const int error = buffers_->take(filled); error != 0) return error;
  taken.taken_us = time_of(filled.about);
  taken.picture = picture_in(filled);
  if (!taken.picture) dropped_frames_.damaged();
  return 0;
}

LiveRead V4l2Source::hand_out(Taken taken) {
  LiveRead read;
  read.status = LiveStatus::Frame;
  Frame frame = maker_->make(std::move(taken.picture));
  frame.index = frames_++;
  frame.pts = taken.taken_us;
  frame.time_s = static_cast<double>(taken.taken_us) * 1e-6;
  frame.duration_s = duration_s_;
  frame.exposure.exposure_s = controls_.fixed_exposure_s();
  read.frame = std::move(frame);
  return read;
}

LiveRead V4l2Source::lost(int error) const {
  const bool gone = error == ENODEV || error == ENXIO;
  return {LiveStatus::Lost, std::nullopt,
          gone ? fmt::format("{}: the camera is gone", info_.name)
               : fmt::format("{}: the camera stopped ({})", info_.name, strerrorname_np(error))};
}

LiveRead V4l2Source::read(milliseconds patience) {
  if (first_) {
    Taken taken = std::move(*first_);
    first_.reset();
    return hand_out(std::move(taken));
  }
  const auto end = steady_clock::now() + patience;
  for (;;) {
    dropped_frames_.tell();
    const auto left = std::chrono::ceil<milliseconds>(end - steady_clock::now());
    pollfd waiting{device_->descriptor(), POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return {};
    Taken taken;
    const int error = take(taken);
    const bool over = (waiting.revents & (POLLERR | POLLHUP)) != 0;
    if (error == EAGAIN && over) return lost(EIO);
    if (error != 0 && error != EAGAIN) return lost(error);
    if (taken.picture) return hand_out(std::move(taken));
    if (steady_clock::now() >= end) return {};
  }
}

}  // namespace

std::unique_ptr<LiveSource> open_v4l2_source(const std::string& address, const LiveRequest& request) {
  return std::make_unique<V4l2Source>(address, request);
}

}  // namespace ar
