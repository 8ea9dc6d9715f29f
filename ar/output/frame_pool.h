#pragma once

#include "ar/capture/ffmpeg.h"
#include "ar/output/sink.h"

namespace ar {

// Picture buffers of one format that are used again once nobody holds them.
class FramePool {
 public:
  explicit FramePool(const PixelFormat& format);

  // Its owner is an AVFrame with the planes' geometry set.
  OutputFrame allocate();

 private:
  PixelFormat format_;
  int native_ = -1;  // AVPixelFormat
  ffmpeg::BufferPoolPtr buffers_;
};

// A frame's picture as an AVFrame: the one that owns it where there is one, else a copy into a buffer of `pool`.
// `frame` is left empty.
ffmpeg::FramePtr picture_of(Frame frame, FramePool& pool);
ffmpeg::FramePtr picture_of(const OutputFrame& frame);

// Throws std::invalid_argument that prints both where the frame is not of the sink's size, chroma or depth.
void check_format(const PixelFormat& found, const PixelFormat& expected);

}  // namespace ar
