#pragma once

#include <filesystem>

#include "ar/capture/file/decoder.h"
#include "ar/capture/file/frame_maker.h"
#include "ar/capture/file/open_source.h"

namespace ar {

// The video stream of one file (or one picture).
class VideoFile : public FrameSource {
 public:
  // Decodes the first frame already, so that what cannot be played is refused here. Throws InputError.
  VideoFile(const std::filesystem::path& path, const OpenOptions& options);

  const SourceInfo& info() const override { return info_; }
  std::optional<Frame> next() override;
  std::int64_t damaged() const override { return decoder_.damaged() + mistimed_; }

 private:
  void describe();
  std::int64_t timestamp_of(const AVFrame& picture);

  Decoder decoder_;
  ffmpeg::FramePtr pending_;  // the first picture, until it is asked for
  FrameMaker maker_;
  SourceInfo info_;
  std::int64_t frames_ = 0;
  std::int64_t last_pts_ = 0;
  std::int64_t usual_duration_ = 1;  // in the stream's time base
  std::int64_t mistimed_ = 0;
};

}  // namespace ar
