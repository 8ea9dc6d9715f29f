#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include "ar/capture/color/converter.h"
#include "ar/capture/ffmpeg.h"
#include "ar/output/sink.h"

namespace ar {

// One video encoder, set up for a source's format, tags and timestamps.
class Encoder {
 public:
  using PacketTaker = std::function<void(AVPacket&)>;

  // `global_header`: the container wants the codec's headers once, in front. Throws std::runtime_error that names
  // `file` where the encoder is missing or refuses the format.
  Encoder(const SourceInfo& source, const VideoSinkOptions& options, bool global_header, std::string file);

  // `picture` in the source's native format. Packets, in the source's time base, go to `take` once they are ready.
  void encode(ffmpeg::FramePtr picture, std::int64_t pts, const PacketTaker& take);
  void flush(const PacketTaker& take);

  const AVCodecContext& context() const { return *context_; }

 private:
  void configure(const SourceInfo& source, const VideoSinkOptions& options, bool global_header);
  void drain(const PacketTaker& take);
  void check(int code, const char* what) const;
  void queue_decoding_time(std::int64_t pts);

  std::string file_;
  bool times_decoding_ = false;            // whether this class, not the codec's library, times the decoding
  std::deque<std::int64_t> decoding_pts_;  // and then when the next packets are decoded, source's time base
  ConvertedFormat format_;
  Converter converter_;
  ffmpeg::CodecPtr context_;
  ffmpeg::PacketPtr packet_;
};

// Whether `container` takes the codec, and what the codec is called in FFmpeg and in messages.
AVCodecID codec_id(VideoCodec codec);
const char* codec_name(VideoCodec codec);

}  // namespace ar
