#include "render/images/image_codec.h"

#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "render/images/image_io.h"
#include "render/images/picture_limits.h"

namespace render {
namespace {

constexpr int kRgba = 4;
constexpr int kRgb = 3;
// Pixels that a byte of a file can hold: deflate reaches 1032 to 1, PNG's smallest pixel is a bit; JPEG codes its least
// block of 8 x 8 in a bit.
constexpr std::uint64_t kCodecPixelsPerByte = 8 * 1032;

void append(void* bytes, void* data, int size) {
  const auto* begin = static_cast<const std::uint8_t*>(data);
  static_cast<Bytes*>(bytes)->insert(static_cast<Bytes*>(bytes)->end(), begin, begin + size);
}

void check_size(const Image& image) {
  const auto expected = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * kRgba;
  if (image.width <= 0 || image.height <= 0 || image.rgba.size() != expected) {
    throw std::runtime_error("an image of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                             " pixels needs width * height * 4 bytes, found " + std::to_string(image.rgba.size()));
  }
}

bool is_opaque(const Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += kRgba) {
    if (image.rgba[i] != 255) return false;
  }
  return true;
}

Bytes without_alpha(const Image& image) {
  Bytes rgb;
  rgb.reserve(image.rgba.size() / kRgba * kRgb);
  for (std::size_t i = 0; i < image.rgba.size(); i += kRgba) {
    rgb.insert(rgb.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  }
  return rgb;
}

}  // namespace

Image decode_image(std::span<const std::uint8_t> bytes) {
  if (bytes.empty()) throw std::runtime_error("the image is empty");
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::runtime_error("the image is larger than 2 GiB");
  }
  const int size = static_cast<int>(bytes.size());
  Image image;
  int channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &image.width, &image.height, &channels) == 0) {
    throw std::runtime_error("neither a PNG nor a JPEG image, or its header is broken");
  }
  check_claimed_size("the image", image.width, image.height, bytes.size(), kCodecPixelsPerByte);
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(bytes.data(), size, &image.width, &image.height, &channels, kRgba), stbi_image_free);
  if (!pixels) throw std::runtime_error(std::string("the image is broken: ") + stbi_failure_reason());
  const auto count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * kRgba;
  image.rgba.assign(pixels.get(), pixels.get() + count);
  return image;
}

Bytes encode_png(const Image& image) {
  check_size(image);
  Bytes png;
  const bool opaque = is_opaque(image);
  const int channels = opaque ? kRgb : kRgba;
  const Bytes rgb = opaque ? without_alpha(image) : Bytes{};
  const std::uint8_t* pixels = opaque ? rgb.data() : image.rgba.data();
  if (stbi_write_png_to_func(append, &png, image.width, image.height, channels, pixels, image.width * channels) == 0) {
    throw std::runtime_error("the PNG encoder ran out of memory");
  }
  return png;
}

Bytes encode_jpeg(const Image& image, int quality) {
  check_size(image);
  Bytes jpeg;
  if (stbi_write_jpg_to_func(append, &jpeg, image.width, image.height, kRgba, image.rgba.data(), quality) == 0) {
    throw std::runtime_error("the JPEG encoder failed");
  }
  return jpeg;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  Bytes png;
  try {
    png = encode_png(image);
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot write PNG '" + path.string() + "': " + error.what());
  }
  write_file_whole(path, png);
}

Image read_png(const std::filesystem::path& path) {
  const Bytes bytes = read_file(path);
  try {
    return decode_image(bytes);
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read PNG '" + path.string() + "': " + error.what());
  }
}

}  // namespace render
