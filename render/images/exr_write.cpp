#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>

#include <cstring>
#include <stdexcept>
#include <string>

#include "render/base/whole_file.h"
#include "render/images/image_io.h"

namespace render {
namespace {

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

}  // namespace

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
