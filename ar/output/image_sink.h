#pragma once

#include <filesystem>
#include <string>

#include "ar/capture/color/converter.h"
#include "ar/output/frame_pool.h"
#include "ar/output/sink.h"
#include "ar/output/temporary_file.h"

namespace ar {

// PNG pictures, RGB of 8 or 16 bits: one ("still.png"), or as many as come, numbered from 0 ("shot_%04d.png").
class ImageSink : public FrameSink {
 public:
  ImageSink(const std::filesystem::path& path, const SourceInfo& source, const VideoSinkOptions& options);

  OutputFrame allocate() override { return pool_.allocate(); }
  void write(OutputFrame frame, std::int64_t pts) override;
  void write_untouched(Frame frame) override;
  void finish() override;

 private:
  void encode(ffmpeg::FramePtr picture);
  void save(const AVPacket& packet) const;
  std::filesystem::path final_name(std::int64_t number) const;

  std::filesystem::path path_;
  bool numbered_;
  PixelFormat format_;
  bool overwrite_;
  TemporaryPath folder_;  // holds all pictures until they are finished
  FramePool pool_;
  Converter converter_;
  ffmpeg::CodecPtr encoder_;
  std::int64_t count_ = 0;
};

}  // namespace ar
