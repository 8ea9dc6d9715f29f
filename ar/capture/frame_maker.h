#pragma once

#include <memory>
#include <string>

#include "ar/capture/converter.h"
#include "ar/capture/orientation.h"
#include "ar/capture/source.h"

namespace ar {

// Turns decoded pictures into upright frames of one format, the first picture's: decides on that format, on its colours
// (guess_color(), logged) and on the way there.
class FrameMaker {
 public:
  // `first`: the first decoded picture; `stream`: what the container adds (turn, tags), may be null. Throws InputError
  // for pixel formats that cannot be held and for PQ and HLG without `options.tone_map_hdr`.
  FrameMaker(const AVFrame& first, const AVStream* stream, const std::string& name, const OpenOptions& options);

  // Fills format, planes, exposure and owner; index and times are the caller's. Throws InputError.
  Frame make(ffmpeg::FramePtr picture);

  // Writes format, tags, sample aspect and rotation.
  void describe(SourceInfo& info) const;

 private:
  void refuse_hdr() const;

  std::string name_;
  PixelFormat format_;
  ColorTags tags_;
  bool tone_mapped_ = false;
  Rational sample_aspect_;
  Orientation orientation_;
  std::unique_ptr<Converter> converter_;
  bool change_told_ = false;
  int first_width_ = 0;
  int first_height_ = 0;
};

}  // namespace ar
