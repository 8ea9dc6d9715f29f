#include "ar/capture/libcamera_source.h"

#include <fmt/format.h>
#include <linux/dma-buf.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>

extern "C" {
#include <libavutil/imgutils.h>
}

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <new>
#include <system_error>
#include <utility>

#include "ar/capture/camera_format.h"
#include "ar/capture/frame_clock.h"
#include "ar/capture/frame_maker.h"
#include "ar/capture/libcamera_controls.h"
#include "ar/capture/libcamera_device.h"
#include "ar/capture/mapped_memory.h"
#include "ar/capture/mjpeg_decoder.h"
#include "ar/capture/pixel_format.h"
#include "ar/capture/trouble_log.h"
#include "ar/error.h"

namespace ar {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr unsigned kBuffers = 4;
constexpr milliseconds kFirstPicture{5000};  // a camera may take seconds to start

std::shared_ptr<libcamera::Camera> find(libcamera::CameraManager& manager, const std::string& id) {
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

[[noreturn]] void refuse(const libcamera::Camera& camera, const std::string& what, int error) {
  if (error == -EBUSY) {
    throw InputError(fmt::format("cannot use {}: another program is using it\nClose that program.", camera.id()));
  }
  throw InputError(fmt::format("cannot use {}: {}: {}\nPlug it in again, or try --source v4l2:.", camera.id(), what,
                               std::strerror(-error)));
}

std::string name_of(const libcamera::Camera& camera) {
  return camera.properties().get(libcamera::properties::Model).value_or(camera.id());
}

// One buffer of the camera's in our memory: where each of its planes begins.
struct MappedBuffer {
  std::unique_ptr<MappedMemory> memory;  // all planes, which share one file
  std::vector<std::size_t> offsets;
  int descriptor = -1;
};

MappedBuffer map(const libcamera::FrameBuffer& buffer, const std::string& name) {
  MappedBuffer mapped;
  std::size_t length = 0;
  const auto& planes = buffer.planes();
  mapped.descriptor = planes.front().fd.get();
  for (const auto& plane : planes) {
    if (plane.fd.get() != mapped.descriptor) {
      throw InputError(
          fmt::format("cannot use {}: the planes of its pictures lie in separate memory\nAsk for a packed "
                      "format (YUYV, RGB3).",
                      name));
    }
    const std::size_t offset = plane.offset == libcamera::FrameBuffer::Plane::kInvalidOffset ? 0 : plane.offset;
    mapped.offsets.push_back(offset);
    length = std::max(length, offset + plane.length);
  }
  try {
    mapped.memory = std::make_unique<MappedMemory>(mapped.descriptor, length, 0);
  } catch (const std::system_error& error) {
    throw InputError(fmt::format("cannot use {}: {}\nPlug it in again.", name, error.what()));
  }
  return mapped;
}

// The time in which the processor reads a buffer that the camera wrote; matters where caches do not know of each other.
class Reading {
 public:
  explicit Reading(int descriptor) : descriptor_(descriptor) { mark(DMA_BUF_SYNC_START); }
  ~Reading() { mark(DMA_BUF_SYNC_END); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

 private:
  void mark(std::uint64_t end) const {
    dma_buf_sync sync{end | DMA_BUF_SYNC_READ};
    ioctl(descriptor_, DMA_BUF_IOCTL_SYNC, &sync);  // memory of another kind needs no such thing and says so
  }
  int descriptor_;
};

class LibcameraSource : public LiveSource {
 public:
  LibcameraSource(const std::string& id, const LiveRequest& request);
  ~LibcameraSource() override;
  LibcameraSource(const LibcameraSource&) = delete;
  LibcameraSource& operator=(const LibcameraSource&) = delete;

  const SourceInfo& info() const override { return info_; }
  std::string identity() const override { return "libcamera:" + camera_->id(); }
  LiveRead read(milliseconds patience) override;
  LiveCounts counts() const override { return trouble_.counts(); }
  CameraControls* controls() override { return &controls_; }

 private:
  void acquire();
  void configure(const LiveRequest& request);
  void make_requests();
  void start(const LiveRequest& request);
  void stop();
  void describe();
  void await_first_picture();
  // On libcamera's own thread.
  void completed(libcamera::Request* request);
  void vanished();

  libcamera::Request* wait_until(steady_clock::time_point end);
  std::optional<Frame> frame_in(libcamera::Request& request);
  ffmpeg::FramePtr picture_in(const libcamera::FrameBuffer& buffer);
  void give_back(libcamera::Request& request);

  std::shared_ptr<libcamera::CameraManager> manager_;  // outlives all below
  std::shared_ptr<libcamera::Camera> camera_;
  lc::Controls controls_;
  TroubleLog trouble_;
  std::unique_ptr<libcamera::CameraConfiguration> configuration_;
  std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
  std::map<const libcamera::FrameBuffer*, MappedBuffer> memory_;
  std::vector<std::unique_ptr<libcamera::Request>> requests_;
  PictureLayout layout_;
  std::optional<MjpegDecoder> decoder_;
  std::optional<FrameMaker> maker_;
  SourceInfo info_;
  double duration_s_ = 0.0;
  FrameClock clock_;
  std::optional<Frame> first_;
  std::int64_t frames_ = 0;

  std::mutex mutex_;
  std::condition_variable change_;
  std::deque<libcamera::Request*> done_;
  bool gone_ = false;
};

LibcameraSource::LibcameraSource(const std::string& id, const LiveRequest& request)
    : manager_(lc::camera_manager()), camera_(find(*manager_, id)), controls_(camera_), trouble_(camera_->id()) {
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
  if (const int error = camera_->acquire(); error != 0) refuse(*camera_, "acquire", error);
}

void LibcameraSource::configure(const LiveRequest& request) {
  configuration_ = camera_->generateConfiguration({libcamera::StreamRole::Viewfinder});
  if (!configuration_ || configuration_->empty()) refuse(*camera_, "no stream to view", -ENODEV);
  libcamera::StreamConfiguration& stream = configuration_->at(0);
  const auto choice = choose_mode(lc::modes_of(stream), request);
  if (!choice) {
    throw InputError(fmt::format("cannot use {}: it does not offer {}\nAsk for another format, or none.", camera_->id(),
                                 request.format ? *request.format : "a format that can be decoded here"));
  }
  for (const libcamera::PixelFormat& format : stream.formats().pixelformats()) {
    if (lc::v4l2_name(format) == choice->mode.format) stream.pixelFormat = format;
  }
  // Of sizes that change in steps libcamera lists a few, but takes more.
  const bool sized = request.width && request.height;
  stream.size = {static_cast<unsigned>(sized ? *request.width : choice->mode.width),
                 static_cast<unsigned>(sized ? *request.height : choice->mode.height)};
  stream.bufferCount = kBuffers;
  if (configuration_->validate() == libcamera::CameraConfiguration::Invalid) {
    refuse(*camera_, "no valid configuration", -EINVAL);
  }
  const auto format = find_camera_format(lc::v4l2_name(stream.pixelFormat));
  if (!format) refuse(*camera_, "its format " + stream.pixelFormat.toString() + " cannot be decoded", -EINVAL);
  if (const int error = camera_->configure(configuration_.get()); error != 0) refuse(*camera_, "configure", error);
  layout_ = {format->pixels, static_cast<int>(stream.size.width), static_cast<int>(stream.size.height),
             static_cast<int>(stream.stride)};
  if (format->codec != AV_CODEC_ID_NONE) decoder_.emplace();
  info_.codec = format->name;
}

void LibcameraSource::make_requests() {
  libcamera::Stream* stream = configuration_->at(0).stream();
  allocator_ = std::make_unique<libcamera::FrameBufferAllocator>(camera_);
  if (const int error = allocator_->allocate(stream); error < 0) refuse(*camera_, "no buffers", error);
  for (const auto& buffer : allocator_->buffers(stream)) {
    memory_.emplace(buffer.get(), map(*buffer, camera_->id()));
    requests_.push_back(camera_->createRequest());
    if (!requests_.back()) throw std::bad_alloc();
    if (const int error = requests_.back()->addBuffer(stream, buffer.get()); error != 0) {
      refuse(*camera_, "no request", error);
    }
  }
}

void LibcameraSource::start(const LiveRequest& request) {
  camera_->requestCompleted.connect(this, &LibcameraSource::completed);
  camera_->disconnected.connect(this, &LibcameraSource::vanished);
  libcamera::ControlList initial = controls_.take();
  if (camera_->controls().find(&libcamera::controls::FrameDurationLimits) != camera_->controls().end()) {
    const std::int64_t us = std::llround(1e6 / request.rate.value_or(kUsualRate));
    initial.set(libcamera::controls::FrameDurationLimits, {us, us});
    info_.frame_rate = {1'000'000, static_cast<int>(us)};
  }
  if (const int error = camera_->start(&initial); error != 0) refuse(*camera_, "start", error);
  for (const auto& each : requests_) {
    if (const int error = camera_->queueRequest(each.get()); error != 0) refuse(*camera_, "queue", error);
  }
}

// May be called in any state.
void LibcameraSource::stop() {
  camera_->stop();
  camera_->requestCompleted.disconnect(this);
  camera_->disconnected.disconnect(this);
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
  info_.name = fmt::format("{} ({})", name_of(*camera_), camera_->id());
  info_.time_base = {1, 1'000'000};
  if (info_.frame_rate.num > 0) duration_s_ = static_cast<double>(info_.frame_rate.den) / info_.frame_rate.num;
  spdlog::info("{}: {} {}x{} through libcamera", info_.name, info_.codec, layout_.width, layout_.height);
}

void LibcameraSource::completed(libcamera::Request* request) {
  if (request->status() == libcamera::Request::RequestCancelled) return;
  const std::lock_guard lock(mutex_);
  done_.push_back(request);
  change_.notify_one();
}

void LibcameraSource::vanished() {
  const std::lock_guard lock(mutex_);
  gone_ = true;
  change_.notify_one();
}

libcamera::Request* LibcameraSource::wait_until(steady_clock::time_point end) {
  std::unique_lock lock(mutex_);
  change_.wait_until(lock, end, [this] { return gone_ || !done_.empty(); });
  if (done_.empty()) return nullptr;
  libcamera::Request* request = done_.front();
  done_.pop_front();
  return request;
}

// Null where the picture is damaged.
ffmpeg::FramePtr LibcameraSource::picture_in(const libcamera::FrameBuffer& buffer) {
  const auto planes = buffer.metadata().planes();
  if (buffer.metadata().status != libcamera::FrameMetadata::FrameSuccess || planes.empty()) return nullptr;
  const MappedBuffer& mapped = memory_.at(&buffer);
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
  trouble_.missed(time.missed);
  controls_.note(request.metadata());

  const Reading reading(memory_.at(&buffer).descriptor);
  ffmpeg::FramePtr picture = picture_in(buffer);
  if (!picture) {
    trouble_.damaged();
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
  if (camera_->queueRequest(&request) != 0) vanished();
}

// Only its first picture says how a compressed stream is sampled.
void LibcameraSource::await_first_picture() {
  const auto end = steady_clock::now() + kFirstPicture;
  while (!first_) {
    libcamera::Request* request = wait_until(end);
    if (request == nullptr) {
      throw InputError(
          fmt::format("cannot use {}: it gave no whole picture in {} s\nPlug it in again, or ask for "
                      "another format.",
                      camera_->id(), kFirstPicture.count() / 1000));
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
  while (libcamera::Request* request = wait_until(end)) {
    read.frame = frame_in(*request);
    give_back(*request);
    trouble_.tell();
    if (!read.frame) continue;
    read.status = LiveStatus::Frame;
    return read;
  }
  const std::lock_guard lock(mutex_);
  if (gone_) {
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
    listing.name = name_of(*camera);
    const auto configuration = camera->generateConfiguration({libcamera::StreamRole::Viewfinder});
    if (configuration && !configuration->empty()) listing.modes = lc::modes_of(configuration->at(0));
    if (!choose_mode(listing.modes, {})) listing.problem = "it offers no format that can be decoded here";
    cameras.push_back(std::move(listing));
  }
  return cameras;
}

}  // namespace ar
