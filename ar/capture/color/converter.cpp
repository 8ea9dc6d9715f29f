#include "ar/capture/color/converter.h"

#include <fmt/format.h>

extern "C" {
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
#include <libavutil/pixdesc.h>
}

#include <stdexcept>
#include <string_view>

#include "ar/capture/color/pixel_format.h"

namespace ar {
namespace {

const char* range_name(AVColorRange range) {
  return range == AVCOL_RANGE_JPEG ? "full" : "limited";
}

// The name of the matrix as the scale filter spells it; its "auto" would be BT.601.
const char* matrix_name(AVColorSpace matrix) {
  switch (matrix) {
    case AVCOL_SPC_BT709:
      return "bt709";
    case AVCOL_SPC_BT2020_NCL:
      return "bt2020";
    default:
      return "bt601";
  }
}

bool is_rgb(AVPixelFormat format) {
  return (av_pix_fmt_desc_get(format)->flags & AV_PIX_FMT_FLAG_RGB) != 0;
}

AVFilterContext* find_filter(const AVFilterGraph& graph, std::string_view type) {
  for (unsigned i = 0; i < graph.nb_filters; ++i) {
    if (graph.filters[i]->filter->name == type) return graph.filters[i];
  }
  return nullptr;
}

void check(int code, const char* what) {
  if (code >= 0) return;
  const std::string complaint = ffmpeg::last_complaint();
  throw std::runtime_error(fmt::format("{}: {}", what, complaint.empty() ? ffmpeg::error_text(code) : complaint));
}

}  // namespace

Converter::Converter(ConvertedFormat target, int threads) : target_(std::move(target)), threads_(threads) {}

bool Converter::is_right(const AVFrame& frame) const {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  if (!target_.filters.empty() || frame.width != target_.width || frame.height != target_.height) return false;
  if (format != target_.format && !(is_native(format) && nearest_native(format) == target_.format)) return false;
  const bool range_ok = frame.color_range == AVCOL_RANGE_UNSPECIFIED || frame.color_range == target_.range;
  const bool matrix_ok = frame.colorspace == AVCOL_SPC_UNSPECIFIED || target_.matrix == AVCOL_SPC_UNSPECIFIED ||
                         frame.colorspace == target_.matrix || is_rgb(target_.format);
  return range_ok && matrix_ok;
}

ffmpeg::FramePtr Converter::convert(ffmpeg::FramePtr frame) {
  if (!is_right(*frame)) {
    const Input input{frame->width, frame->height, frame->format, frame->color_range, frame->colorspace};
    if (!graph_ || input != input_) build(input);
    check(av_buffersrc_add_frame(entry_, frame.get()), "cannot convert a frame");
    frame = ffmpeg::make_frame();
    check(av_buffersink_get_frame(exit_, frame.get()), "cannot convert a frame");
  }
  frame->format = target_.format;
  frame->color_range = target_.range;
  frame->colorspace = target_.matrix;
  return frame;
}

std::string Converter::description(const Input& input) const {
  const auto from = static_cast<AVPixelFormat>(input.format);
  const AVColorRange range = input.range != AVCOL_RANGE_UNSPECIFIED ? input.range : target_.range;
  const AVColorSpace matrix = is_rgb(from) || input.matrix == AVCOL_SPC_UNSPECIFIED ? target_.matrix : input.matrix;
  const AVColorSpace matrix_out = is_rgb(target_.format) ? matrix : target_.matrix;
  std::string text = fmt::format("buffer=video_size={}x{}:pix_fmt={}:time_base=1/1000000:pixel_aspect=1/1,",
                                 input.width, input.height, input.format);
  if (!target_.filters.empty()) text += target_.filters + ',';
  text += fmt::format(
      "scale=w={}:h={}:in_range={}:out_range={}:in_color_matrix={}:out_color_matrix={}"
      ":flags=bicubic+accurate_rnd+full_chroma_int+full_chroma_inp,format=pix_fmts={},buffersink",
      target_.width, target_.height, range_name(range), range_name(target_.range), matrix_name(matrix),
      matrix_name(matrix_out), av_get_pix_fmt_name(target_.format));
  return text;
}

void Converter::build(const Input& input) {
  graph_.reset(avfilter_graph_alloc());
  if (!graph_) throw std::bad_alloc();
  graph_->nb_threads = threads_;
  AVFilterInOut* open_inputs = nullptr;
  AVFilterInOut* open_outputs = nullptr;
  const int parsed = avfilter_graph_parse2(graph_.get(), description(input).c_str(), &open_inputs, &open_outputs);
  avfilter_inout_free(&open_inputs);
  avfilter_inout_free(&open_outputs);
  check(parsed, "cannot set up the conversion of frames");
  check(avfilter_graph_config(graph_.get(), nullptr), "cannot set up the conversion of frames");
  entry_ = find_filter(*graph_, "buffer");
  exit_ = find_filter(*graph_, "buffersink");
  input_ = input;
}

}  // namespace ar
