#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ar::testing {

using Bytes = std::vector<std::uint8_t>;

// Pictures of one size and format that a software webcam shows, over and over.
struct WebcamStream {
  bool mjpeg = false;  // else YUYV
  int width = 0;
  int height = 0;
  std::vector<Bytes> pictures;

  std::uint32_t largest_bytes() const;
};

// Everything a software webcam is. Streams of the same format are sizes of that format; each runs at `fps` and half.
struct WebcamModel {
  std::string serial = "0001";
  unsigned fps = 30;
  std::vector<WebcamStream> streams;  // all of one format side by side

  std::uint32_t interval_100ns(bool half_rate) const { return (half_rate ? 20'000'000U : 10'000'000U) / fps; }
};

// Ids inside the device's video function; USB Video Class 1.1 calls them entities.
inline constexpr unsigned kCameraTerminal = 1;
inline constexpr unsigned kProcessingUnit = 2;
inline constexpr unsigned kVideoEndpoint = 0x81;  // bulk, to the host

// USB 2.0, 9.6, and USB Video Class 1.1, 3: what the device says of itself.
Bytes device_descriptor();
Bytes device_qualifier();
Bytes configuration_descriptor(const WebcamModel& model);
Bytes string_descriptor(const WebcamModel& model, unsigned index);  // empty: no such string

// The stream behind the class's format and frame numbers, which count from 1; null where there is none.
const WebcamStream* find_stream(const WebcamModel& model, unsigned format, unsigned frame);

}  // namespace ar::testing
