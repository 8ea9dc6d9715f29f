#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ar/capture/ffmpeg.h"

struct v4l2_pix_format;

namespace ar {

// A pixel format that cameras name by four letters and that can be decoded here.
struct CameraFormat {
  const char* name;      // V4L2's FourCC
  AVPixelFormat pixels;  // AV_PIX_FMT_NONE: compressed, see `codec`
  AVCodecID codec;       // AV_CODEC_ID_NONE: raw
};

// Nothing for formats that cannot be decoded.
std::optional<CameraFormat> find_camera_format(const std::string& name);
// 0 for the format to be preferred, all else being equal; one that cannot be decoded comes last.
int camera_format_rank(const std::string& name);

// V4L2's 32-bit code and its four letters ("Y16 -BE" where the top bit says big-endian).
std::uint32_t fourcc_code(const std::string& name);
std::string fourcc_name(std::uint32_t code);

// Where a raw picture's samples lie in one buffer: V4L2's planes of NV12 and YU12 follow each other, and rows of YU12's
// chroma are half as long as those of its luma, padding included.
struct PictureLayout {
  AVPixelFormat pixels = AV_PIX_FMT_NONE;
  int width = 0;
  int height = 0;
  int stride_bytes = 0;  // of the first plane
  std::size_t bytes() const;
};

// An AVFrame over `memory`, whose first `bytes()` hold the picture; it keeps `memory` alive.
ffmpeg::FramePtr picture_on(const PictureLayout& layout, AVBufferRef* memory);

// What a V4L2 driver says of the meaning of its samples, on an AVFrame: what it leaves open by its documented defaults
// (V4L2_MAP_*_DEFAULT), what even that leaves open as unspecified.
void tag_colors(const v4l2_pix_format& described, AVFrame& picture);

}  // namespace ar
