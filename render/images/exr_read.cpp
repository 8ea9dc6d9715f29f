#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "render/base/whole_file.h"
#include "render/images/finite_pixels.h"
#include "render/images/image_io.h"
#include "render/images/picture_limits.h"
#include "render/images/primaries.h"

namespace render {
namespace {

// What the best compressions reach on one channel of half floats: 516 pixels a byte with deflate (1032 to 1), 16512
// with DWA, which codes 8 x 8 pixels as two such numbers.
constexpr std::uint64_t kExrPixelsPerByte = 600;
constexpr std::uint64_t kDwaPixelsPerByte = 20000;
// A display window larger than the data window costs the file nothing: so many pixels of it are taken, or 16 times
// the data window's.
constexpr std::int64_t kMaxFramePixels = std::int64_t{1} << 24;

class MemoryIn : public Imf::IStream {
 public:
  MemoryIn(const Bytes& bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
  bool read(char c[], int n) override {
    const auto count = static_cast<std::uint64_t>(n);
    if (n < 0 || position_ > bytes_.size() || count > bytes_.size() - position_) {
      throw std::runtime_error("the file is truncated");
    }
    std::memcpy(c, bytes_.data() + position_, count);
    position_ += count;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const Bytes& bytes_;
  std::uint64_t position_ = 0;
};

struct Size {
  std::int64_t width = 0;
  std::int64_t height = 0;
};

Size size_of(const Imath::Box2i& window) {
  return {std::int64_t{window.max.x} - window.min.x + 1, std::int64_t{window.max.y} - window.min.y + 1};
}

LinearImage black_image(const Imath::Box2i& window) {
  const Size size = size_of(window);
  LinearImage image{static_cast<int>(size.width), static_cast<int>(size.height), {}};
  image.rgb.assign(static_cast<std::size_t>(size.width * size.height), glm::vec3(0.0F));
  return image;
}

// Reads the header alone, before OpenEXR reserves memory for what it claims.
void check_header(const Bytes& bytes, const std::string& name) {
  constexpr std::size_t kVersionAt = 4;
  constexpr std::size_t kHeaderAt = 8;
  if (bytes.size() < kHeaderAt) throw std::runtime_error("the file is truncated");
  if (!Imf::isImfMagic(reinterpret_cast<const char*>(bytes.data()))) throw std::runtime_error("not an EXR file");
  int version = 0;
  for (std::size_t i = kHeaderAt; i-- > kVersionAt;) version = version << 8 | bytes[i];
  MemoryIn stream(bytes, name);
  stream.seekg(kHeaderAt);
  Imf::Header header;
  header.readFrom(stream, version);
  const Imf::Compression compression = header.compression();
  const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  const Size data = size_of(header.dataWindow());
  check_claimed_size("its data window", data.width, data.height, bytes.size(),
                     dwa ? kDwaPixelsPerByte : kExrPixelsPerByte);
  const Size display = size_of(header.displayWindow());
  constexpr std::uint64_t kAny = kMaxPixels;  // its size costs the file nothing
  check_claimed_size("its display window", display.width, display.height, bytes.size(), kAny);
  if (display.width * display.height > std::max(kMaxFramePixels, 16 * data.width * data.height)) {
    throw std::runtime_error(fmt::format(
        "its display window of {} x {} pixels is larger than 2^24 pixels and than 16 times its data window of {} x {}",
        display.width, display.height, data.width, data.height));
  }
}

// Luminance and chroma come subsampled; OpenEXR's own RGBA interface rebuilds them, in the file's primaries.
LinearImage read_luminance_chroma(const Bytes& bytes, const std::string& name) {
  MemoryIn stream(bytes, name);
  Imf::RgbaInputFile file(stream);
  const Imath::Box2i window = file.dataWindow();
  LinearImage image = black_image(window);
  std::vector<Imf::Rgba> pixels(image.rgb.size());
  file.setFrameBuffer(Imf::ComputeBasePointer(pixels.data(), window), 1, static_cast<std::size_t>(image.width));
  file.readPixels(window.min.y, window.max.y);
  std::transform(pixels.begin(), pixels.end(), image.rgb.begin(), [](const Imf::Rgba& p) {
    return glm::vec3(static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b));
  });
  return image;
}

// Channels R, G and B, or Y as grey.
LinearImage read_channels(Imf::InputFile& file, bool rgb) {
  const Imath::Box2i window = file.header().dataWindow();
  LinearImage image = black_image(window);
  const std::size_t row = sizeof(glm::vec3) * static_cast<std::size_t>(image.width);
  Imf::FrameBuffer buffer;
  const char* names[3] = {rgb ? "R" : "Y", "G", "B"};
  for (int c = 0; c < (rgb ? 3 : 1); ++c) {
    buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, &image.rgb.front()[c], window, sizeof(glm::vec3), row));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  if (!rgb) {
    for (glm::vec3& pixel : image.rgb) pixel = glm::vec3(pixel.x);
  }
  return image;
}

std::string names_of(const Imf::ChannelList& channels) {
  std::string names;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
    names += names.empty() ? "" : ", ";
    names += channel.name();
  }
  return names.empty() ? "none" : names;
}

// `image`, the data window's pixels, where they belong in the display window; black around them.
LinearImage in_display_window(LinearImage image, const Imath::Box2i& data, const Imath::Box2i& display) {
  if (data == display) return image;
  LinearImage framed = black_image(display);
  const std::int64_t left = std::max(data.min.x, display.min.x);
  const std::int64_t right = std::min(data.max.x, display.max.x);
  if (left > right) return framed;
  for (std::int64_t y = std::max(data.min.y, display.min.y); y <= std::min(data.max.y, display.max.y); ++y) {
    const auto from = image.rgb.begin() + (y - data.min.y) * image.width + (left - data.min.x);
    const auto to = framed.rgb.begin() + (y - display.min.y) * framed.width + (left - display.min.x);
    std::copy_n(from, right - left + 1, to);
  }
  return framed;
}

LinearImage decode_exr(const Bytes& bytes, const std::string& name) {
  check_header(bytes, name);
  MemoryIn stream(bytes, name);
  Imf::InputFile file(stream);
  const Imf::Header& header = file.header();
  const Imf::ChannelList& channels = header.channels();
  const bool rgb = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
  if (!rgb && !channels.findChannel("Y")) {
    throw std::runtime_error("found the channels " + names_of(channels) + ", accepted are R, G, B or Y, RY, BY or Y");
  }
  const bool chroma = !rgb && (channels.findChannel("RY") || channels.findChannel("BY"));
  LinearImage image = chroma ? read_luminance_chroma(bytes, name) : read_channels(file, rgb);
  replace_invalid_values(image, name);
  // The format's default is Rec. 709. Luminance alone stays grey, whatever the white.
  if ((rgb || chroma) && Imf::hasChromaticities(header)) to_rec709(Imf::chromaticities(header), image);
  return in_display_window(std::move(image), header.dataWindow(), header.displayWindow());
}

}  // namespace

LinearImage read_exr(const std::filesystem::path& path) {
  const Bytes bytes = read_file(path);
  try {
    return decode_exr(bytes, path.string());
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read EXR '" + path.string() + "': " + error.what());
  }
}

}  // namespace render
