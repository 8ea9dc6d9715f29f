#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include <algorithm>
#include <cstring>
#include <glm/mat3x3.hpp>
#include <stdexcept>
#include <string>

#include "render/base/whole_file.h"
#include "render/images/image_io.h"
#include "render/images/picture_limits.h"

namespace render {
namespace {

// A broken header must not claim the machine's memory: 2^28 pixels are 3 GiB of floats.

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

class MemoryOut : public Imf::OStream {
 public:
  explicit MemoryOut(const std::string& name) : OStream(name.c_str()) {}
  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (bytes_.size() < position_ + count) bytes_.resize(position_ + count);
    std::memcpy(bytes_.data() + position_, c, count);
    position_ += count;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
  std::uint64_t position_ = 0;
};

LinearImage empty_image(const Imath::Box2i& window) {
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width <= 0 || height <= 0 || width > kMaxPixels || height > kMaxPixels || width * height > kMaxPixels) {
    throw std::runtime_error("its data window of " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels is empty or larger than 2^28 pixels");
  }
  LinearImage image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.rgb.resize(static_cast<std::size_t>(width * height));
  return image;
}

// Luminance and chroma come subsampled; OpenEXR's own RGBA interface rebuilds them.
LinearImage read_luminance_chroma(const Bytes& bytes, const std::string& name) {
  MemoryIn stream(bytes, name);
  Imf::RgbaInputFile file(stream);
  const Imath::Box2i window = file.dataWindow();
  LinearImage image = empty_image(window);
  std::vector<Imf::Rgba> pixels(image.rgb.size());
  const std::ptrdiff_t origin = window.min.x + std::ptrdiff_t{window.min.y} * image.width;
  file.setFrameBuffer(pixels.data() - origin, 1, static_cast<std::size_t>(image.width));
  file.readPixels(window.min.y, window.max.y);
  std::transform(pixels.begin(), pixels.end(), image.rgb.begin(), [](const Imf::Rgba& p) {
    return glm::vec3(static_cast<float>(p.r), static_cast<float>(p.g), static_cast<float>(p.b));
  });
  return image;
}

void to_rec709(const Imf::Header& header, LinearImage& image) {
  if (!Imf::hasChromaticities(header)) return;  // the format's default is Rec. 709
  const Imf::Chromaticities source = Imf::chromaticities(header);
  if (source == Imf::Chromaticities()) return;
  const Imath::M44f m = Imf::RGBtoXYZ(source, 1.0F) * Imf::XYZtoRGB(Imf::Chromaticities(), 1.0F);
  for (glm::vec3& rgb : image.rgb) {
    const Imath::V3f out = Imath::V3f(rgb.x, rgb.y, rgb.z) * m;
    rgb = glm::vec3(out.x, out.y, out.z);
  }
}

LinearImage read_channels(const Bytes& bytes, const std::string& name) {
  MemoryIn stream(bytes, name);
  Imf::InputFile file(stream);
  const Imf::ChannelList& channels = file.header().channels();
  const bool has_rgb = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
  if (!has_rgb && !channels.findChannel("Y")) {
    throw std::runtime_error("it has no channels R, G, B nor Y");
  }
  if (!has_rgb && (channels.findChannel("RY") || channels.findChannel("BY"))) {
    return read_luminance_chroma(bytes, name);
  }
  const Imath::Box2i window = file.header().dataWindow();
  LinearImage image = empty_image(window);
  const std::size_t row = sizeof(glm::vec3) * static_cast<std::size_t>(image.width);
  Imf::FrameBuffer buffer;
  const char* names[3] = {has_rgb ? "R" : "Y", "G", "B"};
  for (int c = 0; c < (has_rgb ? 3 : 1); ++c) {
    buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, &image.rgb.front()[c], window, sizeof(glm::vec3), row));
  }
  file.setFrameBuffer(buffer);
  file.readPixels(window.min.y, window.max.y);
  if (!has_rgb) {
    for (glm::vec3& rgb : image.rgb) rgb = glm::vec3(rgb.x);
  } else {
    to_rec709(file.header(), image);
  }
  return image;
}

}  // namespace

LinearImage read_exr(const std::filesystem::path& path) {
  const Bytes bytes = read_file(path);
  try {
    return read_channels(bytes, path.string());
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read EXR '" + path.string() + "': " + error.what());
  }
}

void write_exr(const std::filesystem::path& path, const LinearImage& image) {
  const auto count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.rgb.size() != count) {
    throw std::runtime_error("cannot write EXR '" + path.string() + "': " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels, but " + std::to_string(image.rgb.size()) +
                             " values");
  }
  MemoryOut stream(path.string());
  try {
    Imf::Header header(image.width, image.height);
    Imf::FrameBuffer buffer;
    const std::size_t row = sizeof(glm::vec3) * static_cast<std::size_t>(image.width);
    const char* names[3] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
      header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
      // The library reads through a pointer that is not const.
      auto* base = reinterpret_cast<char*>(const_cast<float*>(&image.rgb.front()[c]));
      buffer.insert(names[c], Imf::Slice(Imf::FLOAT, base, sizeof(glm::vec3), row));
    }
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(buffer);
    file.writePixels(image.height);
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot write EXR '" + path.string() + "': " + error.what());
  }
  write_file_whole(path, stream.bytes());
}

}  // namespace render
