#include "ar/capture/libcamera/source.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

extern "C" {
#include <libavutil/imgutils.h>
}

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <utility>

#include "ar/capture/color/pixel_format.h"
#include "ar/capture/file/frame_maker.h"
#include "ar/capture/libcamera/controls.h"
#include "ar/capture/libcamera/device.h"
#include "ar/capture/libcamera/memory.h"
#include "ar/capture/libcamera/requests.h"
#include "ar/capture/live/camera_format.h"
#include "ar/capture/live/dropped_frame_log.h"
#include "ar/capture/live/frame_clock.h"
#include "ar/capture/v4l2/mjpeg_decoder.h"
#include "ar/error.h"

namespace ar {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kFirstRequest{5000};  // a camera may take seconds to start

class LibcameraSource : public LiveSource {
 public:
  LibcameraSource(const std::string& id, const LiveRequest& request);
  ~LibcameraSource() override;
  LibcameraSource(const LibcameraSource&) = delete;
  LibcameraSource& operator=(const LibcameraSource&) = delete;

  const SourceInfo& info() const override { return info_; }
  std::string identity() const override { return "libcamera:" + camera_->id(); }
  LiveRead read(milliseconds patience) override;
  LiveCounts counts() const override { return dropped_frames_.counts(); }
  CameraControls* controls() override { return &controls_; }

 private:
  void acquire();
  void configure(const LiveRequest& request);
  void make_requests();
  void start(const LiveRequest& request);
  void stop();
  void describe();
  void await_first_picture();
  std::optional<Frame> frame_in(libcamera::Request& request);
  ffmpeg::FramePtr picture_in(const libcamera::FrameBuffer& buffer);
  void give_back(libcamera::Request& request);

  std::shared_ptr<libcamera::CameraManager> manager_;  // outlives all below
  std::shared_ptr<libcamera::Camera> camera_;
  lc::Controls controls_;
  DroppedFrameLog dropped_frames_;
  std::unique_ptr<libcamera::CameraConfiguration> configuration_;
  std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
  std::map<const libcamera::FrameBuffer*, lc::MappedBuffer> memory_;
  std::vector<std::unique_ptr<libcamera::Request>> requests_;
  PictureLayout layout_;
  std::optional<MjpegDecoder> decoder_;
  std::optional<FrameMaker> maker_;
  SourceInfo info_;
  double duration_s_ = 0.0;
  FrameClock clock_;
  std::optional<Frame> first_;
  std::int64_t frames_ = 0;
  lc::CompletedRequests completed_;
};

LibcameraSource::LibcameraSource(const std::string& id, const LiveRequest& request)
    : manager_(lc::camera_manager()),
      camera_(lc::find_camera(*manager_, id)),
      controls_(camera_),
      dropped_frames_(camera_->id()) {
  acquire();
  try {
    configure(request);
    make_requests();
    apply(request.controls, controls_, camera_->id());
    start(request);
    if (decoder_) await_first_picture();
  } catch (...) {
    stop();
    throw;
  }
  describe();
}

LibcameraSource::~LibcameraSource() {
  stop();
}

void LibcameraSource::acquire() {
  if (const int error = camera_->acquire(); error != 0) lc::refuse(*camera_, "acquire", error);
}

void LibcameraSource::configure(const LiveRequest& request) {
  configuration_ = lc::configure(*camera_, request);
  const libcamera::StreamConfiguration& stream = configuration_->at(0);
  const CameraFormat format = *find_camera_format(lc::v4l2_name(stream.pixelFormat));
  layout_ = {format.pixels, static_cast<int>(stream.size.width), static_cast<int>(stream.size.height),
             static_cast<int>(stream.stride)};
  if (format.codec != AV_CODEC_ID_NONE) decoder_.emplace();
  info_.codec = format.name;
}

void LibcameraSource::make_requests() {
  libcamera::Stream* stream = configuration_->at(0).stream();
  allocator_ = std::make_unique<libcamera::FrameBufferAllocator>(camera_);
  if (const int error = allocator_->allocate(stream); error < 0) lc::refuse(*camera_, "no buffers", error);
  for (const auto& buffer : allocator_->buffers(stream)) {
    memory_.emplace(buffer.get(), lc::map(*buffer, camera_->id()));
    requests_.push_back(camera_->createRequest());
    if (!requests_.back()) throw std::bad_alloc();
    if (const int error = requests_.back()->addBuffer(stream, buffer.get()); error != 0) {
      lc::refuse(*camera_, "no request", error);
    }
  }
}

void LibcameraSource::start(const LiveRequest& request) {
  completed_.listen_to(*camera_);
  libcamera::ControlList initial = controls_.take();
  if (camera_->controls().find(&libcamera::controls::FrameDurationLimits) != camera_->controls().end()) {
    const std::int64_t us = std::llround(1e6 / request.rate.value_or(kUsualRate));
    initial.set(libcamera::controls::FrameDurationLimits, {us, us});
    info_.frame_rate = {1'000'000, static_cast<int>(us)};
  }
  if (const int error = camera_->start(&initial); error != 0) lc::refuse(*camera_, "start", error);
  for (const auto& each : requests_) {
    if (const int error = camera_->queueRequest(each.get()); error != 0) lc::refuse(*camera_, "queue", error);
  }
}

// May be called in any state.
void LibcameraSource::stop() {
  camera_->stop();
  completed_.ignore(*camera_);
  requests_.clear();
  memory_.clear();
  allocator_.reset();
  camera_->release();
}

void LibcameraSource::describe() {
  if (!maker_) {
    const ffmpeg::FramePtr like = ffmpeg::make_frame();
    like->format = layout_.pixels;
    like->width = layout_.width;
    like->height = layout_.height;
    if (const auto& color = configuration_->at(0).colorSpace) lc::tag_colors(*color, *like);
    maker_.emplace(*like, nullptr, camera_->id(), OpenOptions{.threads = 1});
  }
  maker_->describe(info_);
  info_.name = fmt::format("{} ({})", lc::name_of(*camera_), camera_->id());
  info_.time_base = {1, 1'000'000};
  if (info_.frame_rate.num > 0) duration_s_ = static_cast<double>(info_.frame_rate.den) / info_.frame_rate.num;
  spdlog::info("{}: {} {}x{} through libcamera", info_.name, info_.codec, layout_.width, layout_.height);
}

// Null where the picture is damaged.
ffmpeg::FramePtr LibcameraSource::picture_in(const libcamera::FrameBuffer& buffer) {
  const auto planes = buffer.metadata().planes();
  if (buffer.metadata().status != libcamera::FrameMetadata::FrameSuccess || planes.empty()) return nullptr;
  const lc::MappedBuffer& mapped = memory_.at(&buffer);
  std::uint8_t* const start = mapped.memory->data();
  if (decoder_) {
    const std::size_t used = std::min<std::size_t>(planes[0].bytesused, mapped.memory->length());
    return used == 0 ? nullptr : decoder_->decode({start + mapped.offsets[0], used});
  }
  std::size_t used = 0;
  for (const auto& plane : planes) used += plane.bytesused;
  if (used < layout_.bytes()) return nullptr;
  ffmpeg::BufferPtr memory(av_buffer_create(
      start, mapped.memory->length(), [](void*, std::uint8_t*) {}, nullptr, AV_BUFFER_FLAG_READONLY));
  if (!memory) throw std::bad_alloc();
  ffmpeg::FramePtr picture = picture_on(layout_, memory.get());
  for (std::size_t i = 0; i < mapped.offsets.size(); ++i) picture->data[i] = start + mapped.offsets[i];
  if (const auto& color = configuration_->at(0).colorSpace) lc::tag_colors(*color, *picture);
  // Its buffers end with the camera: what needs no conversion, which copies anyway, is copied.
  if (is_native(layout_.pixels) && av_frame_make_writable(picture.get()) < 0) throw std::bad_alloc();
  return picture;
}

std::optional<Frame> LibcameraSource::frame_in(libcamera::Request& request) {
  const libcamera::FrameBuffer& buffer = *request.buffers().begin()->second;
  const libcamera::FrameMetadata& about = buffer.metadata();
  DriverStamp stamp{about.sequence, std::nullopt};
  if (about.timestamp != 0) stamp.taken_us = static_cast<std::int64_t>(about.timestamp / 1000);
  const auto now = std::chrono::duration_cast<std::chrono::microseconds>(steady_clock::now().time_since_epoch());
  const FrameClock::Reading time = clock_.read(stamp, now.count());
  dropped_frames_.missed(time.missed);
  controls_.note(request.metadata());

  const lc::Reading reading(memory_.at(&buffer).descriptor);
  ffmpeg::FramePtr picture = picture_in(buffer);
  if (!picture) {
    dropped_frames_.damaged();
    return std::nullopt;
  }
  if (!maker_) maker_.emplace(*picture, nullptr, camera_->id(), OpenOptions{.threads = 1});
  Frame frame = maker_->make(std::move(picture));
  frame.index = frames_++;
  frame.pts = time.taken_us;
  frame.time_s = static_cast<double>(time.taken_us) * 1e-6;
  frame.duration_s = duration_s_;
  frame.exposure = lc::exposure_of(request.metadata());
  return frame;
}

void LibcameraSource::give_back(libcamera::Request& request) {
  request.reuse(libcamera::Request::ReuseBuffers);
  request.controls().merge(controls_.take());
  if (camera_->queueRequest(&request) != 0) completed_.give_up();
}

// Only its first picture says how a compressed stream is sampled.
void LibcameraSource::await_first_picture() {
  const auto end = steady_clock::now() + kFirstRequest;
  while (!first_) {
    libcamera::Request* request = completed_.wait_until(end);
    if (request == nullptr) {
      throw InputError(
          fmt::format("cannot use {}: it gave no whole picture in {} s\nPlug it in again, or ask for "
                      "another format.",
                      camera_->id(), kFirstRequest.count() / 1000));
    }
    first_ = frame_in(*request);
    give_back(*request);
  }
}

LiveRead LibcameraSource::read(milliseconds patience) {
  LiveRead read;
  if (first_) {
    read.status = LiveStatus::Frame;
    read.frame = std::exchange(first_, std::nullopt);
    return read;
  }
  const auto end = steady_clock::now() + patience;
  while (libcamera::Request* request = completed_.wait_until(end)) {
    read.frame = frame_in(*request);
    give_back(*request);
    dropped_frames_.tell();
    if (!read.frame) continue;
    read.status = LiveStatus::Frame;
    return read;
  }
  if (completed_.over()) {
    read.status = LiveStatus::Lost;
    read.reason = fmt::format("{}: the camera is gone", info_.name);
  }
  return read;
}

}  // namespace

std::unique_ptr<LiveSource> open_libcamera_source(const std::string& id, const LiveRequest& request) {
  return std::make_unique<LibcameraSource>(id, request);
}

std::vector<CameraListing> list_libcamera_cameras() {
  std::vector<CameraListing> cameras;
  const auto manager = lc::camera_manager();
  for (const auto& camera : manager->cameras()) {
    CameraListing listing;
    listing.source = "libcamera:" + camera->id();
    listing.name = lc::name_of(*camera);
    const auto configuration = camera->generateConfiguration({libcamera::StreamRole::Viewfinder});
    if (configuration && !configuration->empty()) listing.modes = lc::modes_of(configuration->at(0));
    if (!choose_mode(listing.modes, {})) listing.problem = "it offers no format that can be decoded here";
    cameras.push_back(std::move(listing));
  }
  return cameras;
}

}  // namespace ar
