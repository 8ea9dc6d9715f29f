#include "ar/output/encoder.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <stdexcept>

#include "ar/capture/color/color.h"
#include "ar/capture/color/pixel_format.h"

namespace ar {
namespace {

// Frames that x265 may move one behind: a pyramid of B-frames, in all of its presets.
constexpr int kX265Reorder = 2;

const char* encoder_name(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::H264:
      return "libx264";
    case VideoCodec::Hevc:
      return "libx265";
    case VideoCodec::Ffv1:
      break;
  }
  return "ffv1";
}

ColorTags tags_of(const SourceInfo& source) {
  return source.tags.value_or(tags_from_color(source.format.color));
}

// RGB is what hardly any player takes in H.264 and HEVC: it becomes limited-range BT.709. FFV1 keeps it, 8 bits of it
// packed. x264 and x265 halve no odd size: such pictures keep their chroma whole.
ConvertedFormat encoded_format(const SourceInfo& source, VideoCodec codec, ColorTags& tags) {
  const PixelFormat& format = source.format;
  const ColorTags color = tags_from_color(format.color);
  ConvertedFormat encoded{native_format(format),
                          format.width,
                          format.height,
                          static_cast<AVColorRange>(color.range),
                          static_cast<AVColorSpace>(color.matrix),
                          ""};
  const bool rgb = format.color.matrix == ColorMatrix::Rgb;
  if (codec == VideoCodec::Ffv1) {
    if (encoded.format == AV_PIX_FMT_GBRP) encoded.format = AV_PIX_FMT_BGR0;
    return encoded;
  }
  PixelFormat wanted = format;
  if (rgb) {
    wanted.color.matrix = ColorMatrix::Bt709;
    wanted.chroma = Chroma::C420;
    encoded.matrix = AVCOL_SPC_BT709;
    encoded.range = AVCOL_RANGE_MPEG;
    tags.matrix = AVCOL_SPC_BT709;
    tags.range = AVCOL_RANGE_MPEG;
    tags.siting = AVCHROMA_LOC_LEFT;
    spdlog::info("RGB pictures are written as 4:2:0 BT.709 (FFV1 keeps RGB)");
  }
  const bool odd_x = format.width % 2 != 0 && wanted.chroma != Chroma::C444;
  const bool odd_y = format.height % 2 != 0 && wanted.chroma == Chroma::C420;
  if (odd_x || odd_y) {
    wanted.chroma = Chroma::C444;
    spdlog::warn("{}x{} is an odd size: written as 4:4:4, which some players do not take", format.width, format.height);
  }
  encoded.format = native_format(wanted);
  return encoded;
}

// A key frame a second, so that whoever was killed loses no more.
int keyframe_distance(Rational frame_rate) {
  constexpr int kUsual = 30;
  return frame_rate.num > 0 ? std::max(1, frame_rate.num / std::max(1, frame_rate.den)) : kUsual;
}

}  // namespace

AVCodecID codec_id(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::H264:
      return AV_CODEC_ID_H264;
    case VideoCodec::Hevc:
      return AV_CODEC_ID_HEVC;
    case VideoCodec::Ffv1:
      break;
  }
  return AV_CODEC_ID_FFV1;
}

const char* codec_name(VideoCodec codec) {
  switch (codec) {
    case VideoCodec::H264:
      return "H.264";
    case VideoCodec::Hevc:
      return "HEVC";
    case VideoCodec::Ffv1:
      break;
  }
  return "FFV1";
}

Encoder::Encoder(const SourceInfo& source, const VideoSinkOptions& options, bool global_header, std::string file)
    : file_(std::move(file)), converter_({}), packet_(ffmpeg::make_packet()) {
  configure(source, options, global_header);
}

void Encoder::configure(const SourceInfo& source, const VideoSinkOptions& options, bool global_header) {
  const AVCodec* encoder = avcodec_find_encoder_by_name(encoder_name(options.codec));
  if (encoder == nullptr) {
    throw std::runtime_error(fmt::format("cannot write {}: this FFmpeg has no {} encoder ({})\nChoose another codec.",
                                         file_, codec_name(options.codec), encoder_name(options.codec)));
  }
  ColorTags tags = tags_of(source);
  format_ = encoded_format(source, options.codec, tags);
  converter_ = Converter(format_, options.threads);
  context_.reset(avcodec_alloc_context3(encoder));
  if (!context_) throw std::bad_alloc();
  AVCodecContext& c = *context_;
  c.width = format_.width;
  c.height = format_.height;
  c.pix_fmt = format_.format;
  c.time_base = {source.time_base.num, source.time_base.den};
  if (source.frame_rate.num > 0) c.framerate = {source.frame_rate.num, source.frame_rate.den};
  c.sample_aspect_ratio = {source.sample_aspect.num, source.sample_aspect.den};
  c.color_primaries = static_cast<AVColorPrimaries>(tags.primaries);
  c.color_trc = static_cast<AVColorTransferCharacteristic>(tags.transfer);
  c.colorspace = static_cast<AVColorSpace>(tags.matrix);
  c.color_range = static_cast<AVColorRange>(tags.range);
  c.chroma_sample_location = static_cast<AVChromaLocation>(tags.siting);
  c.thread_count = options.threads;
  if (global_header) c.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;

  ffmpeg::Dictionary settings;
  if (options.codec == VideoCodec::Ffv1) {
    c.level = 3;  // slices with checksums
    c.gop_size = 1;
    settings.set("slicecrc", "1");
  } else {
    settings.set("preset", options.preset);
    settings.set("crf", std::to_string(options.crf));
    if (options.live) {
      settings.set("tune", "zerolatency");
      c.gop_size = keyframe_distance(source.frame_rate);
    }
  }
  if (options.codec == VideoCodec::Hevc) {
    std::string x265 = "log-level=error";
    if (options.threads > 0) x265 += fmt::format(":pools={}", options.threads);
    settings.set("x265-params", x265);
    times_decoding_ = true;
    c.codec_tag = MKTAG('h', 'v', 'c', '1');  // the spelling that Apple's players take
  }
  ffmpeg::last_complaint();
  check(avcodec_open2(context_.get(), encoder, settings.out()), "cannot set up the encoder");
}

void Encoder::check(int code, const char* what) const {
  if (code >= 0) return;
  const std::string complaint = ffmpeg::last_complaint();
  throw std::runtime_error(
      fmt::format("cannot write {}: {}: {}", file_, what, complaint.empty() ? ffmpeg::error_text(code) : complaint));
}

void Encoder::drain(const PacketTaker& take) {
  for (;;) {
    const int code = avcodec_receive_packet(context_.get(), packet_.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    check(code, "encoding failed");
    if (times_decoding_ && !decoding_pts_.empty()) {
      packet_->dts = decoding_pts_.front();
      decoding_pts_.pop_front();
    }
    take(*packet_);
    av_packet_unref(packet_.get());
  }
}

// x265 3.5 takes its delay from the frame of that number, and from uninitialised memory where a clip is shorter. A
// packet is decoded when the frame that many places before it is shown; the first ones one tick after another before.
void Encoder::queue_decoding_time(std::int64_t pts) {
  if (context_->frame_number == 0 && decoding_pts_.empty()) {
    for (int i = kX265Reorder; i > 0; --i) decoding_pts_.push_back(pts - i);
  }
  decoding_pts_.push_back(pts);
}

void Encoder::encode(ffmpeg::FramePtr picture, std::int64_t pts, const PacketTaker& take) {
  picture = converter_.convert(std::move(picture));
  picture->pts = pts;
  picture->pict_type = AV_PICTURE_TYPE_NONE;  // else the encoder would repeat the source's key frames
  picture->color_primaries = context_->color_primaries;
  picture->color_trc = context_->color_trc;
  picture->colorspace = context_->colorspace;
  picture->color_range = context_->color_range;
  picture->sample_aspect_ratio = context_->sample_aspect_ratio;
  if (times_decoding_) queue_decoding_time(pts);
  check(avcodec_send_frame(context_.get(), picture.get()), "encoding failed");
  drain(take);
}

void Encoder::flush(const PacketTaker& take) {
  check(avcodec_send_frame(context_.get(), nullptr), "encoding failed");
  drain(take);
}

}  // namespace ar
