#pragma once

#include <cstdint>
#include <span>

#include "ar/capture/ffmpeg.h"

namespace ar {

// Decodes the JPEG pictures of a camera, one by one.
class MjpegDecoder {
 public:
  MjpegDecoder();

  // Nothing where the picture is damaged or cut short. `jpeg` is copied first: it may be given back at once.
  ffmpeg::FramePtr decode(std::span<const std::uint8_t> jpeg);

 private:
  ffmpeg::CodecPtr codec_;
  ffmpeg::PacketPtr packet_;
};

}  // namespace ar
