#include "tests/lab/lab.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "ar/capture/ffmpeg.h"
#include "ar/capture/v4l2/device.h"

namespace ar::testing {
namespace {

// A test that waits for ever says which it is, and is the end: whatever it waits for would hold up all others too.
class Patience : public ::testing::EmptyTestEventListener {
 public:
  static constexpr unsigned kLongestS = 180;

 private:
  void OnTestStart(const ::testing::TestInfo& test) override {
    said_ = fmt::format("lab: {}.{} has not ended in {} seconds\n", test.test_suite_name(), test.name(), kLongestS);
    std::signal(SIGALRM, [](int) {
      // What a handler may call; whether it is written or not, this ends here.
      [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, said_.data(), said_.size());
      _exit(1);
    });
    alarm(kLongestS);
  }
  void OnTestEnd(const ::testing::TestInfo&) override { alarm(0); }

  static inline std::string said_;
};

// googletest's own main() runs these tests; listeners are added before it.
const bool patient = [] {
  ::testing::UnitTest::GetInstance()->listeners().Append(new Patience);
  return true;
}();

using std::chrono::steady_clock;

constexpr int kBits = 10;  // of a picture's number

// An 8-bit level of picture `number` at x: a block of each bit, then a ramp so that pictures are not flat.
unsigned level(int number, int x, int y, int width, int height) {
  const int block = x * kBits / width;
  if (y < height / 2) return (number >> block & 1) != 0 ? 235U : 16U;
  return 16U + static_cast<unsigned>((x + y + number) % 200);
}

Bytes yuyv(int number, int width, int height) {
  Bytes bytes;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      bytes.push_back(static_cast<std::uint8_t>(level(number, x, y, width, height)));
      bytes.push_back(x % 2 == 0 ? 128 : 120);
    }
  }
  return bytes;
}

Bytes jpeg(int number, int width, int height) {
  const AVCodec* encoder = avcodec_find_encoder(AV_CODEC_ID_MJPEG);
  const ffmpeg::CodecPtr codec(avcodec_alloc_context3(encoder));
  codec->width = width;
  codec->height = height;
  codec->pix_fmt = AV_PIX_FMT_YUVJ420P;
  codec->time_base = {1, 30};
  codec->flags |= AV_CODEC_FLAG_QSCALE;
  codec->global_quality = 2 * FF_QP2LAMBDA;
  if (avcodec_open2(codec.get(), encoder, nullptr) < 0) throw std::runtime_error("no JPEG encoder");
  const ffmpeg::FramePtr picture = ffmpeg::make_frame();
  picture->format = codec->pix_fmt;
  picture->width = width;
  picture->height = height;
  picture->quality = codec->global_quality;
  if (av_frame_get_buffer(picture.get(), 0) < 0) throw std::bad_alloc();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture->data[0][y * picture->linesize[0] + x] = static_cast<std::uint8_t>(level(number, x, y, width, height));
    }
  }
  for (int plane = 1; plane < 3; ++plane) {
    std::memset(picture->data[plane], 128, static_cast<std::size_t>(picture->linesize[plane] * ((height + 1) / 2)));
  }
  const ffmpeg::PacketPtr packet = ffmpeg::make_packet();
  if (avcodec_send_frame(codec.get(), picture.get()) < 0 || avcodec_receive_packet(codec.get(), packet.get()) < 0) {
    throw std::runtime_error("the JPEG encoder failed");
  }
  return {packet->data, packet->data + packet->size};
}

int open_node(const std::string& node) {
  const int descriptor = open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) throw std::runtime_error(fmt::format("{}: {}", node, std::strerror(errno)));
  return descriptor;
}

}  // namespace

std::string node_of(const std::string& driver, bool outputs) {
  for (const auto& node : v4l2::list_nodes()) {
    try {
      const v4l2::Device device(node);
      if (device.driver() == driver && (outputs ? device.outputs() : device.captures())) return node.string();
    } catch (const std::runtime_error&) {
      continue;  // it may be on its way in or out
    }
  }
  return {};
}

std::string await_node(const std::string& driver) {
  std::string node;
  if (!eventually([&] { return !(node = node_of(driver)).empty(); })) throw std::runtime_error("no device: " + driver);
  if (std::system("udevadm settle --timeout=20") != 0) throw std::runtime_error("udev does not settle");
  return node;
}

const WebcamModel& unplugged(const WebcamModel& next) {
  EXPECT_TRUE(eventually([] { return node_of("uvcvideo").empty(); }));
  return next;
}

void set_control(const std::string& node, const std::string& name, int value) {
  const int descriptor = open_node(node);
  v4l2_queryctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  int result = -1;
  while (ioctl(descriptor, VIDIOC_QUERYCTRL, &query) == 0) {
    if (name == reinterpret_cast<const char*>(query.name)) {
      v4l2_control control{query.id, value};
      result = ioctl(descriptor, VIDIOC_S_CTRL, &control);
      break;
    }
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  close(descriptor);
  if (result != 0) throw std::runtime_error(fmt::format("{} does not take '{}' = {}", node, name, value));
}

std::int64_t get_control(const std::string& node, std::uint32_t id) {
  const int descriptor = open_node(node);
  v4l2_control control{id, 0};
  const int result = ioctl(descriptor, VIDIOC_G_CTRL, &control);
  close(descriptor);
  if (result != 0) throw std::runtime_error(fmt::format("{} has no control {:#x}", node, id));
  return control.value;
}

bool eventually(const std::function<bool()>& done, std::chrono::milliseconds patience) {
  const auto end = steady_clock::now() + patience;
  while (!done()) {
    if (steady_clock::now() > end) return false;
    std::this_thread::sleep_for(50ms);
  }
  return true;
}

Frame next_frame(LiveSource& source) {
  const auto end = steady_clock::now() + 20s;
  while (steady_clock::now() < end) {
    LiveRead read = source.read(500ms);
    if (read.status == LiveStatus::Frame) return std::move(*read.frame);
    if (read.status != LiveStatus::Quiet) {
      ADD_FAILURE() << "the source ended: " << read.reason;
      return {};
    }
  }
  ADD_FAILURE() << "no frame in 20 s";
  return {};
}

LiveRead read_to_end(LiveSource& source) {
  const auto end = steady_clock::now() + 20s;
  while (steady_clock::now() < end) {
    LiveRead read = source.read(500ms);
    if (read.status == LiveStatus::Lost || read.status == LiveStatus::End) return read;
  }
  return {};
}

std::string refusal(const std::string& specification, const LiveRequest& request) {
  try {
    const auto source = open_live_source(specification, request);
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

Rgb sample(const Frame& frame, int x, int y) {
  const auto at = [&](std::size_t plane) -> double {
    const bool chroma = plane > 0 && frame.format.chroma != Chroma::C444;
    const int column = chroma ? x / 2 : x;
    const int row = plane > 0 && frame.format.chroma == Chroma::C420 ? y / 2 : y;
    return frame.plane[plane][row * frame.stride_bytes[plane] + column];
  };
  if (frame.format.color.matrix == ColorMatrix::Rgb) return {at(2), at(0), at(1)};
  const bool full = frame.format.color.range == ColorRange::Full;
  const double luma = full ? at(0) : (at(0) - 16.0) * 255.0 / 219.0;
  const double scale = full ? 1.0 : 255.0 / 224.0;
  const double cb = (at(1) - 128.0) * scale;
  const double cr = (at(2) - 128.0) * scale;
  const bool hd = frame.format.color.matrix == ColorMatrix::Bt709;
  const double kr = hd ? 0.2126 : 0.299;
  const double kb = hd ? 0.0722 : 0.114;
  const double r = luma + 2 * (1 - kr) * cr;
  const double b = luma + 2 * (1 - kb) * cb;
  return {r, (luma - kr * r - kb * b) / (1 - kr - kb), b};
}

WebcamStream numbered_pictures(bool mjpeg, int width, int height, int count) {
  WebcamStream stream{mjpeg, width, height, {}};
  for (int i = 0; i < count; ++i) {
    stream.pictures.push_back(mjpeg ? jpeg(i, width, height) : yuyv(i, width, height));
  }
  return stream;
}

int number_in(const Frame& frame) {
  int number = 0;
  for (int bit = 0; bit < kBits; ++bit) {
    const int x = (2 * bit + 1) * frame.format.width / (2 * kBits);
    if (frame.plane[0][frame.format.height / 4 * frame.stride_bytes[0] + x] > 125) number |= 1 << bit;
  }
  return number;
}

std::int64_t own_bytes() {
  std::ifstream status("/proc/self/status");
  std::int64_t kibibytes = -1;
  for (std::string word; status >> word;) {
    if (word == "RssAnon:") status >> kibibytes;
  }
  EXPECT_GE(kibibytes, 0) << "the kernel tells nothing of it";
  return kibibytes * 1024;
}

SmallPages::SmallPages() {
  EXPECT_EQ(prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0), 0);
}

SmallPages::~SmallPages() {
  prctl(PR_SET_THP_DISABLE, 0, 0, 0, 0);
}

int open_files() {
  const auto files = std::filesystem::directory_iterator("/proc/self/fd");
  return static_cast<int>(std::distance(begin(files), end(files)));
}

}  // namespace ar::testing
