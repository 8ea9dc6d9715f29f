#include "ar/output/v4l2/v4l2_sink.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <linux/videodev2.h>
#include <spdlog/spdlog.h>

extern "C" {
#include <libavutil/imgutils.h>
}

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "ar/capture/color/converter.h"
#include "ar/capture/live/camera_format.h"
#include "ar/capture/live/mapped_memory.h"
#include "ar/capture/v4l2/device.h"
#include "ar/error.h"
#include "ar/output/frame_pool.h"

namespace ar {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kBuffers = 4;

// The number of /dev/videoN, or one that is free.
int node_number(const std::string& address) {
  constexpr std::string_view kPrefix = "/dev/video";
  if (address.starts_with(kPrefix)) return std::atoi(address.c_str() + kPrefix.size());
  return 10;
}

std::string how_to_make_one(const std::string& address) {
  return fmt::format(
      "Make one (package v4l2loopback-dkms): sudo modprobe v4l2loopback video_nr={} card_label=Skyshaft "
      "exclusive_caps=1",
      node_number(address));
}

std::shared_ptr<const v4l2::Device> open_output(const std::string& address) {
  std::error_code error;
  if (!address.empty() && !fs::exists(address, error)) {
    throw InputError(fmt::format("cannot write to {}: no such device\n{}", address, how_to_make_one(address)));
  }
  if (!address.empty()) {
    auto device = std::make_shared<const v4l2::Device>(address);
    if (device->outputs()) return device;
    throw InputError(
        fmt::format("cannot write to {} ({}): it takes no pictures\n{}", address, device->card(), how_to_make_one("")));
  }
  for (const fs::path& node : v4l2::list_nodes()) {
    try {
      auto device = std::make_shared<const v4l2::Device>(node);
      if (device->outputs()) return device;
    } catch (const InputError& skipped) {
      spdlog::debug("{}", skipped.what());
    }
  }
  throw InputError("there is no V4L2 output device\n" + how_to_make_one(""));
}

// What our samples mean, in V4L2's words: transfer and matrix as they are, the range always limited.
void describe_colors(const ColorInfo& color, v4l2_pix_format& format) {
  const bool hd = color.matrix == ColorMatrix::Bt709;
  format.colorspace = color.transfer == Transfer::Srgb ? V4L2_COLORSPACE_SRGB
                      : hd                             ? V4L2_COLORSPACE_REC709
                                                       : V4L2_COLORSPACE_SMPTE170M;
  format.ycbcr_enc = hd ? V4L2_YCBCR_ENC_709 : V4L2_YCBCR_ENC_601;
  format.quantization = V4L2_QUANTIZATION_LIM_RANGE;
}

// Sets one of `names`; throws where the device takes none of them.
v4l2_pix_format set_format(const v4l2::Device& device, const PixelFormat& wanted,
                           const std::vector<std::string>& names) {
  v4l2_format format{};
  for (const std::string& name : names) {
    format = {};
    format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    v4l2_pix_format& pixels = format.fmt.pix;
    pixels.width = static_cast<std::uint32_t>(wanted.width);
    pixels.height = static_cast<std::uint32_t>(wanted.height);
    pixels.pixelformat = fourcc_code(name);
    pixels.field = V4L2_FIELD_NONE;
    describe_colors(wanted.color, pixels);
    device.require(VIDIOC_S_FMT, &format, "VIDIOC_S_FMT");
    if (pixels.pixelformat == fourcc_code(name)) return pixels;
  }
  throw InputError(fmt::format("cannot write to {} ({}): it takes {}, not {}\nGive another output device.",
                               device.node().string(), device.card(), fourcc_name(format.fmt.pix.pixelformat),
                               fmt::join(names, " or ")));
}

void set_rate(const v4l2::Device& device, const Rational& rate) {
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  if (rate.num <= 0 || device.call(VIDIOC_G_PARM, &parameters) != 0) return;
  parameters.parm.output.timeperframe = {static_cast<std::uint32_t>(rate.den), static_cast<std::uint32_t>(rate.num)};
  // Only a hint to those who read: a device without it works as well.
  device.call(VIDIOC_S_PARM, &parameters);
}

ConvertedFormat converted_format(const PictureLayout& layout, const ColorInfo& color) {
  const bool hd = color.matrix == ColorMatrix::Bt709;
  return {layout.pixels, layout.width, layout.height, AVCOL_RANGE_MPEG, hd ? AVCOL_SPC_BT709 : AVCOL_SPC_SMPTE170M, ""};
}

// RGB, and matrices that V4L2's readers hardly know, go out as BT.709.
ColorInfo output_color(ColorInfo color) {
  if (color.matrix != ColorMatrix::Bt601) color.matrix = ColorMatrix::Bt709;
  return color;
}

class V4l2Sink : public FrameSink {
 public:
  V4l2Sink(const std::string& address, const SourceInfo& source, const std::optional<std::string>& format);
  ~V4l2Sink() override;

  OutputFrame allocate() override { return pool_.allocate(); }
  void write(OutputFrame frame, std::int64_t pts) override;
  void write_untouched(Frame frame) override;
  void finish() override;

 private:
  void map_buffers();
  void send(ffmpeg::FramePtr picture);
  std::optional<std::uint32_t> free_buffer();
  v4l2_buffer numbered(std::uint32_t index) const;

  PixelFormat format_;
  FramePool pool_;
  std::shared_ptr<const v4l2::Device> device_;
  PictureLayout layout_;
  std::optional<Converter> converter_;
  std::vector<std::unique_ptr<MappedMemory>> buffers_;
  std::vector<std::uint32_t> free_;
  bool streaming_ = false;
  std::int64_t written_ = 0;
  std::int64_t left_out_ = 0;
};

V4l2Sink::V4l2Sink(const std::string& address, const SourceInfo& source, const std::optional<std::string>& format)
    : format_(source.format), pool_(source.format), device_(open_output(address)) {
  if (format && *format != "YUYV" && *format != "NV12") {
    throw InputError(fmt::format("cannot write {} to {}\nGive YUYV or NV12.", *format, device_->node().string()));
  }
  const std::vector<std::string> names = format ? std::vector{*format} : std::vector<std::string>{"YUYV", "NV12"};
  PixelFormat wanted = format_;
  wanted.color = output_color(format_.color);
  const v4l2_pix_format set = set_format(*device_, wanted, names);
  set_rate(*device_, source.frame_rate);
  layout_ = {find_camera_format(fourcc_name(set.pixelformat))->pixels, static_cast<int>(set.width),
             static_cast<int>(set.height), static_cast<int>(set.bytesperline)};
  if (layout_.width != format_.width || layout_.height != format_.height) {
    spdlog::warn("{} ({}) takes {}x{}; pictures are scaled to that", device_->node().string(), device_->card(),
                 layout_.width, layout_.height);
  }
  converter_.emplace(converted_format(layout_, wanted.color), 1);
  map_buffers();
  spdlog::info("{} ({}): {} {}x{}", device_->node().string(), device_->card(), fourcc_name(set.pixelformat),
               layout_.width, layout_.height);
}

V4l2Sink::~V4l2Sink() {
  int type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  if (streaming_) device_->call(VIDIOC_STREAMOFF, &type);
}

v4l2_buffer V4l2Sink::numbered(std::uint32_t index) const {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  buffer.field = V4L2_FIELD_NONE;
  buffer.bytesused = static_cast<std::uint32_t>(layout_.bytes());
  return buffer;
}

void V4l2Sink::map_buffers() {
  v4l2_requestbuffers request{};
  request.count = kBuffers;
  request.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  request.memory = V4L2_MEMORY_MMAP;
  device_->require(VIDIOC_REQBUFS, &request, "VIDIOC_REQBUFS");
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = numbered(i);
    device_->require(VIDIOC_QUERYBUF, &buffer, "VIDIOC_QUERYBUF");
    if (buffer.length < layout_.bytes()) {
      throw InputError(
          fmt::format("cannot write to {}: its buffers hold {} bytes, a picture is {}\nGive another "
                      "output device.",
                      device_->node().string(), buffer.length, layout_.bytes()));
    }
    try {
      buffers_.push_back(std::make_unique<MappedMemory>(device_->descriptor(), buffer.length, buffer.m.offset,
                                                        MappedMemory::Access::ReadAndWrite));
    } catch (const std::system_error& error) {
      throw InputError(v4l2::explain(device_->node(), "mmap", error.code().value()));
    }
    free_.push_back(i);
  }
}

// Nothing where all still wait for the device.
std::optional<std::uint32_t> V4l2Sink::free_buffer() {
  if (free_.empty()) {
    v4l2_buffer buffer = numbered(0);
    const int error = device_->call(VIDIOC_DQBUF, &buffer);
    if (error == EAGAIN) return std::nullopt;
    if (error != 0) throw InputError(v4l2::explain(device_->node(), "VIDIOC_DQBUF", error));
    return buffer.index;
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  return index;
}

void V4l2Sink::send(ffmpeg::FramePtr picture) {
  const auto index = free_buffer();
  if (!index) {
    ++left_out_;
    return;
  }
  picture = converter_->convert(std::move(picture));
  const MappedMemory& memory = *buffers_.at(*index);
  AVBufferRef* borrowed = av_buffer_create(
      memory.data(), memory.length(), [](void*, std::uint8_t*) {}, nullptr, 0);
  if (borrowed == nullptr) throw std::bad_alloc();
  const ffmpeg::FramePtr target = picture_on(layout_, borrowed);
  av_buffer_unref(&borrowed);
  if (const int copied = av_frame_copy(target.get(), picture.get()); copied < 0) {
    throw std::runtime_error("cannot copy a picture: " + ffmpeg::error_text(copied));
  }
  v4l2_buffer buffer = numbered(*index);
  device_->require(VIDIOC_QBUF, &buffer, "VIDIOC_QBUF");
  if (!streaming_) {
    int type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    device_->require(VIDIOC_STREAMON, &type, "VIDIOC_STREAMON");
    streaming_ = true;
  }
  ++written_;
}

void V4l2Sink::write(OutputFrame frame, std::int64_t /*pts*/) {
  check_format(frame.format, format_);
  send(picture_of(frame));
}

void V4l2Sink::write_untouched(Frame frame) {
  check_format(frame.format, format_);
  send(picture_of(std::move(frame), pool_));
}

void V4l2Sink::finish() {
  if (left_out_ > 0) {
    spdlog::info("{}: {} frames written, {} left out because it was not ready", device_->node().string(), written_,
                 left_out_);
  }
}

}  // namespace

std::unique_ptr<FrameSink> open_v4l2_sink(const std::string& address, const SourceInfo& source,
                                          const std::optional<std::string>& format) {
  return std::make_unique<V4l2Sink>(address, source, format);
}

}  // namespace ar
