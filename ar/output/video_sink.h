#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "ar/output/encoder.h"
#include "ar/output/frame_pool.h"
#include "ar/output/sink.h"
#include "ar/output/stream_copy.h"
#include "ar/output/temporary_file.h"

namespace ar {

// A video file through one of FFmpeg's muxers.
class VideoSink : public FrameSink {
 public:
  VideoSink(const std::filesystem::path& path, const SourceInfo& source, const VideoSinkOptions& options);

  OutputFrame allocate() override { return pool_.allocate(); }
  void write(OutputFrame frame, std::int64_t pts) override;
  void write_untouched(Frame frame) override;
  void finish() override;

 private:
  void open_muxer();
  void write_header();
  void tag_file();
  void encode(ffmpeg::FramePtr picture, std::int64_t pts);
  void mux_video(AVPacket& packet);
  void mux(AVPacket& packet);
  void check(int code, const char* what) const;

  SourceInfo source_;
  bool live_;
  TemporaryPath file_;
  FramePool pool_;
  ffmpeg::MuxerPtr muxer_;
  std::unique_ptr<Encoder> encoder_;
  AVStream* video_ = nullptr;  // of muxer_
  std::unique_ptr<StreamCopy> others_;
  std::int64_t first_pts_ = 0;  // becomes time 0
  std::optional<std::int64_t> last_pts_;
  std::int64_t last_step_ = 0;  // between the last two timestamps
};

}  // namespace ar
