#pragma once

#include <memory>
#include <string>

#include "ar/capture/color/converter.h"
#include "ar/capture/color/orientation.h"
#include "ar/capture/file/open_source.h"

namespace ar {

// Turns decoded pictures into upright frames of one format, the first picture's: decides on that format, on its colours
// (guess_color(), logged) and on the way there.
class FrameMaker {
 public:
  // `first`: the first decoded picture; `stream`: what the container adds (turn, tags), may be null. Throws InputError
  // for pixel formats that cannot be held and for PQ and HLG without `options.tone_map_hdr`.
  FrameMaker(const AVFrame& first, const AVStream* stream, const std::string& name, const OpenOptions& options);

  // Fills format, planes, exposure and owner; index and times are the caller's. A picture of another upright size than
  // the first is scaled with a warning in a video, which is one recording; of `separate_pictures`, each with a turn of
  // its own, it is refused. Throws InputError.
  Frame make(ffmpeg::FramePtr picture, bool separate_pictures = false);

  // Writes format, tags, sample aspect and rotation.
  void describe(SourceInfo& info) const;

 private:
  void refuse_hdr() const;
  void check_size(const AVFrame& picture, bool separate_pictures);
  void set_orientation(const Orientation& orientation);

  std::string name_;
  PixelFormat format_;
  ColorTags tags_;
  Rational sample_aspect_;
  Orientation orientation_;
  int threads_;
  std::string tone_mapping_;  // filters; empty where there is none
  AVPixelFormat native_ = AV_PIX_FMT_NONE;
  std::unique_ptr<Converter> converter_;
  bool change_notified_ = false;
};

}  // namespace ar
