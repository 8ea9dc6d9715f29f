#include "tests/lab/uvc_descriptors.h"

#include <algorithm>
#include <initializer_list>

namespace ar::testing {
namespace {

void put(Bytes& out, std::initializer_list<unsigned> bytes) {
  for (const unsigned byte : bytes) out.push_back(static_cast<std::uint8_t>(byte));
}

void put16(Bytes& out, std::uint32_t value) {
  put(out, {value & 0xffU, (value >> 8U) & 0xffU});
}

void put32(Bytes& out, std::uint32_t value) {
  put16(out, value & 0xffffU);
  put16(out, value >> 16U);
}

void append(Bytes& out, const Bytes& more) {
  out.insert(out.end(), more.begin(), more.end());
}

std::vector<const WebcamStream*> streams_of(const WebcamModel& model, bool mjpeg) {
  std::vector<const WebcamStream*> streams;
  for (const WebcamStream& stream : model.streams) {
    if (stream.mjpeg == mjpeg) streams.push_back(&stream);
  }
  return streams;
}

// The formats in their order: that of the first stream first.
std::vector<bool> formats_of(const WebcamModel& model) {
  std::vector<bool> formats;
  for (const WebcamStream& stream : model.streams) {
    if (std::find(formats.begin(), formats.end(), stream.mjpeg) == formats.end()) formats.push_back(stream.mjpeg);
  }
  return formats;
}

// 3.7.2: camera (exposure mode and time, focus and its automatic), processing (brightness, white balance and its
// automatic, gain), way out.
Bytes entities() {
  Bytes out;
  put(out, {18, 0x24, 0x02, kCameraTerminal, 0x01, 0x02, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0x2a, 0x00, 0x02});
  put(out, {12, 0x24, 0x05, kProcessingUnit, kCameraTerminal, 0, 0, 2, 0x41, 0x12, 0, 0});
  put(out, {9, 0x24, 0x03, 3, 0x01, 0x01, 0, kProcessingUnit, 0});
  return out;
}

void put_frame(Bytes& out, const WebcamModel& model, const WebcamStream& stream, unsigned number) {
  const std::uint32_t bits = stream.largest_bytes() * 8;
  put(out, {26 + 2 * 4, 0x24, stream.mjpeg ? 0x07U : 0x05U, number, 0});
  put16(out, static_cast<std::uint32_t>(stream.width));
  put16(out, static_cast<std::uint32_t>(stream.height));
  put32(out, bits * std::max(1U, model.fps / 2));
  put32(out, bits * model.fps);
  put32(out, stream.largest_bytes());
  put32(out, model.interval_100ns(false));
  put(out, {2});
  put32(out, model.interval_100ns(false));
  put32(out, model.interval_100ns(true));
}

// 3.9.2: each format with its sizes, and sRGB primaries and transfer with the matrix of BT.601.
Bytes formats(const WebcamModel& model) {
  Bytes out;
  unsigned number = 0;
  for (const bool mjpeg : formats_of(model)) {
    const auto streams = streams_of(model, mjpeg);
    const auto sizes = static_cast<unsigned>(streams.size());
    ++number;
    if (mjpeg) {
      put(out, {11, 0x24, 0x06, number, sizes, 0, 1, 0, 0, 0, 0});
    } else {
      put(out, {27, 0x24, 0x04, number, sizes, 'Y',  'U',  'Y', '2', 0, 0, 0x10, 0, 0x80,
                0,  0,    0xaa, 0,      0x38,  0x9b, 0x71, 16,  1,   0, 0, 0,    0});
    }
    for (unsigned i = 0; i < sizes; ++i) put_frame(out, model, *streams[i], i + 1);
    put(out, {6, 0x24, 0x0d, 1, 1, 4});
  }
  return out;
}

}  // namespace

std::uint32_t WebcamStream::largest_bytes() const {
  std::size_t largest = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 2;
  for (const Bytes& picture : pictures) largest = std::max(largest, picture.size());
  return static_cast<std::uint32_t>(largest);
}

Bytes device_descriptor() {
  // 1d6b is the Linux Foundation's; 0104 a multifunction device made of software.
  return {18, 1, 0x00, 0x02, 0xef, 2, 1, 64, 0x6b, 0x1d, 0x04, 0x01, 0x00, 0x01, 1, 2, 3, 1};
}

Bytes device_qualifier() {
  return {10, 6, 0x00, 0x02, 0xef, 2, 1, 64, 1, 0};
}

Bytes configuration_descriptor(const WebcamModel& model) {
  const Bytes described_entities = entities();
  const Bytes described_formats = formats(model);
  const auto format_count = static_cast<unsigned>(formats_of(model).size());
  Bytes body;
  put(body, {8, 11, 0, 2, 14, 3, 0, 0});    // both interfaces are one function
  put(body, {9, 4, 0, 0, 0, 14, 1, 0, 0});  // the one of controls
  put(body, {13, 0x24, 0x01, 0x10, 0x01});  // version 1.1
  put16(body, static_cast<std::uint32_t>(13 + described_entities.size()));
  put32(body, 48'000'000);
  put(body, {1, 1});
  append(body, described_entities);
  put(body, {9, 4, 1, 0, 1, 14, 2, 0, 0});  // the one of pictures
  put(body, {13 + format_count, 0x24, 0x01, format_count});
  put16(body, static_cast<std::uint32_t>(13 + format_count + described_formats.size()));
  put(body, {kVideoEndpoint, 0, 3, 0, 0, 0, 1});
  body.resize(body.size() + format_count);
  append(body, described_formats);
  put(body, {7, 5, kVideoEndpoint, 2, 0x00, 0x02, 0});  // bulk, 512 bytes

  Bytes out{9, 2};
  put16(out, static_cast<std::uint32_t>(9 + body.size()));
  put(out, {2, 1, 0, 0x80, 250});
  append(out, body);
  return out;
}

Bytes string_descriptor(const WebcamModel& model, unsigned index) {
  if (index == 0) return {4, 3, 0x09, 0x04};
  const std::string strings[] = {"Skyshaft", "Lab webcam", model.serial};
  if (index > std::size(strings)) return {};
  const std::string& text = strings[index - 1];
  Bytes out;
  put(out, {static_cast<unsigned>(2 + 2 * text.size()), 3});
  for (const char letter : text) put16(out, static_cast<unsigned char>(letter));
  return out;
}

const WebcamStream* find_stream(const WebcamModel& model, unsigned format, unsigned frame) {
  const auto known = formats_of(model);
  if (format < 1 || format > known.size()) return nullptr;
  const auto streams = streams_of(model, known[format - 1]);
  return frame < 1 || frame > streams.size() ? nullptr : streams[frame - 1];
}

}  // namespace ar::testing
