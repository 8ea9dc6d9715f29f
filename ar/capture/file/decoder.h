#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "ar/capture/ffmpeg.h"

namespace ar {

// Reads the best video stream of one file, frame by frame in order of presentation, as FFmpeg decodes them.
// Damaged packets are counted, logged once and passed over.
class Decoder {
 public:
  // `name` is what messages call the file; `threads` 0: as many as the machine has. Throws InputError.
  Decoder(const std::filesystem::path& path, std::string name, int threads);

  // Nothing at the end. Throws InputError where the file cannot be read on (not at its damaged or missing end).
  ffmpeg::FramePtr next();

  const AVFormatContext& container() const { return *container_; }
  AVStream& stream() const { return *stream_; }
  const std::string& name() const { return name_; }
  std::int64_t damaged() const { return damaged_; }

 private:
  void open_container(const std::filesystem::path& path);
  void open_codec(int threads);
  void feed();
  void note_damage(int code);
  void note_end();

  std::string name_;
  ffmpeg::DemuxerPtr container_;
  AVStream* stream_ = nullptr;  // of container_
  ffmpeg::CodecPtr codec_;
  ffmpeg::PacketPtr packet_;
  std::int64_t frames_ = 0;
  std::int64_t left_out_ = 0;  // packets that the container itself says not to show
  std::int64_t damaged_ = 0;
  bool ended_ = false;
};

}  // namespace ar
