#pragma once

#include <string>

#include "ar/capture/ffmpeg.h"

namespace ar {

// What every frame that leaves a Converter is like.
struct ConvertedFormat {
  AVPixelFormat format = AV_PIX_FMT_NONE;
  int width = 0;
  int height = 0;
  AVColorRange range = AVCOL_RANGE_UNSPECIFIED;
  AVColorSpace matrix = AVCOL_SPC_UNSPECIFIED;
  std::string filters;  // of libavfilter, run first: turning, tone mapping; empty: none
};

// Brings frames to one format through a filter graph, which is built when the first frame needs it and again whenever
// frames change on the way. Frames that are right already pass untouched. Not thread-safe.
class Converter {
 public:
  // `threads`: 0 as many as the machine has.
  explicit Converter(ConvertedFormat target, int threads = 0);

  // Range and matrix of `frame` count as given (AVFrame's own fields); unspecified ones as the target's. Throws
  // std::runtime_error where FFmpeg knows no way.
  ffmpeg::FramePtr convert(ffmpeg::FramePtr frame);
  const ConvertedFormat& target() const { return target_; }

 private:
  // What a graph was built for.
  struct Input {
    int width = 0;
    int height = 0;
    int format = -1;
    AVColorRange range = AVCOL_RANGE_UNSPECIFIED;
    AVColorSpace matrix = AVCOL_SPC_UNSPECIFIED;
    bool operator==(const Input&) const = default;
  };

  bool is_right(const AVFrame& frame) const;
  void build(const Input& input);
  std::string description(const Input& input) const;

  ConvertedFormat target_;
  int threads_;
  Input input_;
  ffmpeg::FilterGraphPtr graph_;
  AVFilterContext* entry_ = nullptr;  // of graph_
  AVFilterContext* exit_ = nullptr;
};

}  // namespace ar
