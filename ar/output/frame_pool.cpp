#include "ar/output/frame_pool.h"

#include <fmt/format.h>

extern "C" {
#include <libavutil/imgutils.h>
}

#include <stdexcept>

#include "ar/capture/color/color.h"
#include "ar/capture/color/pixel_format.h"

namespace ar {
namespace {

constexpr int kAlignment = 64;  // what the widest vector instructions like

std::string describe(const PixelFormat& format) {
  static constexpr const char* kChroma[] = {"4:2:0", "4:2:2", "4:4:4"};
  return fmt::format("{}x{} {} {} bit{}", format.width, format.height, kChroma[static_cast<int>(format.chroma)],
                     format.bit_depth, format.color.matrix == ColorMatrix::Rgb ? " RGB" : "");
}

}  // namespace

void check_format(const PixelFormat& found, const PixelFormat& expected) {
  const bool same = found.width == expected.width && found.height == expected.height &&
                    found.bit_depth == expected.bit_depth && found.chroma == expected.chroma &&
                    (found.color.matrix == ColorMatrix::Rgb) == (expected.color.matrix == ColorMatrix::Rgb);
  if (!same) {
    throw std::invalid_argument(
        fmt::format("frame is {}, but the output takes {}", describe(found), describe(expected)));
  }
}

FramePool::FramePool(const PixelFormat& format) : format_(format), native_(native_format(format)) {
  const int size =
      av_image_get_buffer_size(static_cast<AVPixelFormat>(native_), format.width, format.height, kAlignment);
  if (size < 0) throw std::invalid_argument("no picture has the format " + describe(format));
  // Encoders read whole vectors, past the end of the last row too.
  buffers_.reset(av_buffer_pool_init(static_cast<std::size_t>(size) + kAlignment, nullptr));
  if (!buffers_) throw std::bad_alloc();
}

OutputFrame FramePool::allocate() {
  std::shared_ptr<AVFrame> picture(ffmpeg::make_frame().release(), ffmpeg::FrameDeleter{});
  picture->buf[0] = av_buffer_pool_get(buffers_.get());
  if (picture->buf[0] == nullptr) throw std::bad_alloc();
  picture->format = native_;
  picture->width = format_.width;
  picture->height = format_.height;
  const ColorTags tags = tags_from_color(format_.color);
  picture->color_range = static_cast<AVColorRange>(tags.range);
  picture->colorspace = static_cast<AVColorSpace>(tags.matrix);
  av_image_fill_arrays(picture->data, picture->linesize, picture->buf[0]->data, static_cast<AVPixelFormat>(native_),
                       format_.width, format_.height, kAlignment);
  OutputFrame frame;
  frame.format = format_;
  for (std::size_t i = 0; i < 3; ++i) {
    frame.plane[i] = picture->data[i];
    frame.stride_bytes[i] = picture->linesize[i];
  }
  frame.owner = std::move(picture);
  return frame;
}

ffmpeg::FramePtr picture_of(const OutputFrame& frame) {
  if (std::get_deleter<ffmpeg::FrameDeleter>(frame.owner) == nullptr) {
    throw std::invalid_argument("frames to be written come from the sink's own allocate()");
  }
  return ffmpeg::share_frame(*static_cast<const AVFrame*>(frame.owner.get()));
}

ffmpeg::FramePtr picture_of(Frame frame, FramePool& pool) {
  // A camera's frames are owned by something else; the deleter tells which is which.
  if (std::get_deleter<ffmpeg::FrameDeleter>(frame.owner) != nullptr) {
    return ffmpeg::share_frame(*static_cast<const AVFrame*>(frame.owner.get()));
  }
  const OutputFrame copy = pool.allocate();
  const auto native = native_format(frame.format);
  for (int i = 0; i < 3; ++i) {
    const auto p = static_cast<std::size_t>(i);
    const int rows = i > 0 && frame.format.chroma == Chroma::C420 ? (frame.format.height + 1) / 2 : frame.format.height;
    av_image_copy_plane(copy.plane[p], static_cast<int>(copy.stride_bytes[p]), frame.plane[p],
                        static_cast<int>(frame.stride_bytes[p]), av_image_get_linesize(native, frame.format.width, i),
                        rows);
  }
  return picture_of(copy);
}

}  // namespace ar
