#include "ar/capture/file/frame_maker.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

extern "C" {
#include <libavutil/display.h>
#include <libavutil/pixdesc.h>
}

#include <stdexcept>

#include "ar/capture/color/color.h"
#include "ar/capture/color/pixel_format.h"
#include "ar/capture/file/metadata.h"
#include "ar/error.h"

namespace ar {
namespace {

const std::int32_t* display_matrix(const AVFrame& frame, const AVStream* stream) {
  if (const AVFrameSideData* data = av_frame_get_side_data(&frame, AV_FRAME_DATA_DISPLAYMATRIX)) {
    return reinterpret_cast<const std::int32_t*>(data->data);
  }
  if (stream == nullptr) return nullptr;
  return reinterpret_cast<const std::int32_t*>(av_stream_get_side_data(stream, AV_PKT_DATA_DISPLAYMATRIX, nullptr));
}

Orientation orientation_of(const AVFrame& frame, const AVStream* stream, const std::string& name) {
  const std::int32_t* matrix = display_matrix(frame, stream);
  if (matrix == nullptr) return {};
  bool exact = true;
  const Orientation orientation = orientation_from_matrix(matrix, &exact);
  if (!exact) {
    spdlog::warn("{}: is to be turned by {:.1f} degrees; turned by {} instead", name, -av_display_rotation_get(matrix),
                 orientation.rotation_deg());
  }
  return orientation;
}

// The decoder's word, else the container's. YUVJ formats and grey say their range by their name.
ColorTags tags_of(const AVFrame& frame, const AVStream* stream) {
  const auto pick = [](int from_frame, int from_stream, int unspecified) {
    return from_frame != unspecified ? from_frame : from_stream;
  };
  ColorTags tags{frame.color_primaries, frame.color_trc, frame.colorspace, frame.color_range, frame.chroma_location};
  if (stream != nullptr) {
    const AVCodecParameters& coded = *stream->codecpar;
    tags.primaries = pick(tags.primaries, coded.color_primaries, AVCOL_PRI_UNSPECIFIED);
    tags.transfer = pick(tags.transfer, coded.color_trc, AVCOL_TRC_UNSPECIFIED);
    tags.matrix = pick(tags.matrix, coded.color_space, AVCOL_SPC_UNSPECIFIED);
    tags.range = pick(tags.range, coded.color_range, AVCOL_RANGE_UNSPECIFIED);
    tags.siting = pick(tags.siting, coded.chroma_location, AVCHROMA_LOC_UNSPECIFIED);
  }
  const AVPixFmtDescriptor* described = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
  const std::string pixel_name = described->name;
  const bool grey = described->nb_components < 3 && (described->flags & AV_PIX_FMT_FLAG_PAL) == 0;
  if (pixel_name.starts_with("yuvj")) tags.range = AVCOL_RANGE_JPEG;
  if (grey && tags.range == AVCOL_RANGE_UNSPECIFIED) tags.range = AVCOL_RANGE_JPEG;
  return tags;
}

bool is_hdr(Transfer transfer) {
  return transfer == Transfer::Pq || transfer == Transfer::Hlg;
}

// To BT.709 SDR through linear light, 100 cd/m2 as white, with Hable's curve. What the tags leave open is BT.2020,
// which PQ and HLG come with.
std::string tone_mapping(const ColorTags& tags, const ColorInfo& color, AVPixelFormat format) {
  const int primaries = color.primaries == Primaries::Unknown ? AVCOL_PRI_BT2020 : tags.primaries;
  const int matrix = color.matrix == ColorMatrix::Unknown ? AVCOL_SPC_BT2020_NCL : tags.matrix;
  return fmt::format(
      "zscale=tin={}:pin={}:min={}:rin={}:t=linear:npl=100,format=gbrpf32le,zscale=p=bt709,tonemap=tonemap=hable:desat="
      "0,"
      "zscale=t=bt709:m=bt709:r=limited,format=pix_fmts={}",
      tags.transfer, primaries, matrix, color.range == ColorRange::Full ? "full" : "limited",
      av_get_pix_fmt_name(format));
}

constexpr ColorInfo kSdr{ColorMatrix::Bt709, ColorRange::Limited, Transfer::Bt709, Primaries::Bt709,
                         ChromaSiting::Left};

Rational upright_aspect(const AVFrame& frame, const AVStream* stream, const Orientation& orientation) {
  AVRational aspect = frame.sample_aspect_ratio;
  if (stream != nullptr && stream->sample_aspect_ratio.num > 0) aspect = stream->sample_aspect_ratio;
  if (aspect.num <= 0 || aspect.den <= 0) return {1, 1};
  return orientation.transpose ? Rational{aspect.den, aspect.num} : Rational{aspect.num, aspect.den};
}

AVPixelFormat format_for(const AVFrame& first, const Orientation& orientation, const std::string& name) {
  try {
    const AVPixelFormat nearest = nearest_native(static_cast<AVPixelFormat>(first.format));
    // A quarter turn makes 4:2:2 into 4:4:0, which nothing here holds.
    if (orientation.transpose && nearest == AV_PIX_FMT_YUV422P) return AV_PIX_FMT_YUV444P;
    if (orientation.transpose && nearest == AV_PIX_FMT_YUV422P10LE) return AV_PIX_FMT_YUV444P10LE;
    return nearest;
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("cannot read {}: {} is not supported\nConvert it to 8- or 10-bit YCbCr or RGB first.",
                                 name, error.what()));
  }
}

}  // namespace

FrameMaker::FrameMaker(const AVFrame& first, const AVStream* stream, const std::string& name,
                       const OpenOptions& options)
    : name_(name),
      tags_(tags_of(first, stream)),
      orientation_(orientation_of(first, stream, name)),
      threads_(options.threads),
      native_(format_for(first, orientation_, name)) {
  describe_native(native_, format_);
  format_.width = orientation_.transpose ? first.height : first.width;
  format_.height = orientation_.transpose ? first.width : first.height;
  sample_aspect_ = upright_aspect(first, stream, orientation_);
  if ((av_pix_fmt_desc_get(native_)->flags & AV_PIX_FMT_FLAG_RGB) != 0) tags_.matrix = AVCOL_SPC_RGB;
  const ColorInfo tagged = color_from_tags(tags_);
  if (is_hdr(tagged.transfer)) {
    if (!options.tone_map_hdr) refuse_hdr();
    tone_mapping_ = tone_mapping(tags_, tagged, native_);
    format_.color = kSdr;
  } else {
    format_.color = guess_color(tagged, first.width, first.height);
    const std::string guessed = describe_guess(tagged, format_.color);
    if (!guessed.empty()) spdlog::info("{}: colour not tagged in full; taken as {}", name, guessed);
  }
  format_.color.siting = siting_after(orientation_, format_.color.siting);
  if (tags_.siting != AVCHROMA_LOC_UNSPECIFIED) tags_.siting = tags_from_color(format_.color).siting;
  set_orientation(orientation_);
}

void FrameMaker::set_orientation(const Orientation& orientation) {
  orientation_ = orientation;
  std::string filters = tone_mapping_;
  if (!filters.empty() && !orientation.upright()) filters += ',';
  filters += orientation.filters();
  const int range = tags_from_color(format_.color).range;
  const int matrix = tone_mapping_.empty() ? tags_.matrix : static_cast<int>(AVCOL_SPC_BT709);
  converter_ = std::make_unique<Converter>(
      ConvertedFormat{native_, format_.width, format_.height, static_cast<AVColorRange>(range),
                      static_cast<AVColorSpace>(matrix), filters},
      threads_);
}

void FrameMaker::refuse_hdr() const {
  throw InputError(
      fmt::format("cannot use {}: it is high dynamic range ({}), which would be composited wrongly\n"
                  "Ask for tone mapping (--tone-map), or convert it to standard dynamic range first.",
                  name_, tags_.transfer == AVCOL_TRC_SMPTE2084 ? "PQ" : "HLG"));
}

void FrameMaker::check_size(const AVFrame& picture, bool separate_pictures) {
  const int width = orientation_.transpose ? picture.height : picture.width;
  const int height = orientation_.transpose ? picture.width : picture.height;
  if (width == format_.width && height == format_.height) return;
  const std::string sizes = fmt::format("{}x{}, the first was {}x{}", width, height, format_.width, format_.height);
  if (separate_pictures) throw InputError(sizes);
  if (!change_notified_) spdlog::warn("{}: the size changes on the way: {}; scaled to the first", name_, sizes);
  change_notified_ = true;
}

Frame FrameMaker::make(ffmpeg::FramePtr picture, bool separate_pictures) {
  if (separate_pictures) {
    const Orientation own = orientation_of(*picture, nullptr, name_);
    if (own != orientation_) set_orientation(own);
  }
  check_size(*picture, separate_pictures);
  Frame frame;
  frame.exposure = exposure_of(picture->metadata);
  try {
    picture = converter_->convert(std::move(picture));
  } catch (const std::runtime_error& error) {
    throw InputError(
        fmt::format("cannot use {}: {}\nConvert it to 8- or 10-bit YCbCr or RGB first.", name_, error.what()));
  }
  frame.format = format_;
  for (std::size_t i = 0; i < 3; ++i) {
    frame.plane[i] = picture->data[i];
    frame.stride_bytes[i] = picture->linesize[i];
  }
  frame.owner = std::shared_ptr<const AVFrame>(picture.release(), ffmpeg::FrameDeleter{});
  return frame;
}

void FrameMaker::describe(SourceInfo& info) const {
  info.format = format_;
  if (tone_mapping_.empty()) info.tags = tags_;
  info.sample_aspect = sample_aspect_;
  info.rotation_deg = orientation_.rotation_deg();
}

}  // namespace ar
