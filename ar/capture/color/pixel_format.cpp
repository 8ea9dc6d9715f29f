#include "ar/capture/color/pixel_format.h"

extern "C" {
#include <libavutil/pixdesc.h>
}

#include <stdexcept>
#include <string>

namespace ar {
namespace {

AVPixelFormat native(bool rgb, Chroma chroma, bool deep) {
  if (rgb) return deep ? AV_PIX_FMT_GBRP10LE : AV_PIX_FMT_GBRP;
  switch (chroma) {
    case Chroma::C420:
      return deep ? AV_PIX_FMT_YUV420P10LE : AV_PIX_FMT_YUV420P;
    case Chroma::C422:
      return deep ? AV_PIX_FMT_YUV422P10LE : AV_PIX_FMT_YUV422P;
    case Chroma::C444:
      break;
  }
  return deep ? AV_PIX_FMT_YUV444P10LE : AV_PIX_FMT_YUV444P;
}

// The J formats differ from the plain ones in their range only, which frames carry beside the format.
AVPixelFormat without_j(AVPixelFormat format) {
  switch (format) {
    case AV_PIX_FMT_YUVJ420P:
      return AV_PIX_FMT_YUV420P;
    case AV_PIX_FMT_YUVJ422P:
      return AV_PIX_FMT_YUV422P;
    case AV_PIX_FMT_YUVJ444P:
      return AV_PIX_FMT_YUV444P;
    default:
      return format;
  }
}

Chroma nearest_chroma(const AVPixFmtDescriptor& format) {
  if (format.nb_components < 3) return Chroma::C420;  // grey: the chroma planes are flat
  if (format.log2_chroma_w == 0) return Chroma::C444;
  return format.log2_chroma_h == 0 ? Chroma::C422 : Chroma::C420;
}

}  // namespace

bool is_native(AVPixelFormat format) {
  switch (without_j(format)) {
    case AV_PIX_FMT_YUV420P:
    case AV_PIX_FMT_YUV422P:
    case AV_PIX_FMT_YUV444P:
    case AV_PIX_FMT_YUV420P10LE:
    case AV_PIX_FMT_YUV422P10LE:
    case AV_PIX_FMT_YUV444P10LE:
    case AV_PIX_FMT_GBRP:
    case AV_PIX_FMT_GBRP10LE:
      return true;
    default:
      return false;
  }
}

AVPixelFormat nearest_native(AVPixelFormat format) {
  if (is_native(format)) return without_j(format);
  const AVPixFmtDescriptor* described = av_pix_fmt_desc_get(format);
  constexpr std::uint64_t kUnholdable = AV_PIX_FMT_FLAG_FLOAT | AV_PIX_FMT_FLAG_BAYER | AV_PIX_FMT_FLAG_HWACCEL;
  const bool xyz = format == AV_PIX_FMT_XYZ12LE || format == AV_PIX_FMT_XYZ12BE;
  if (described == nullptr || xyz || (described->flags & kUnholdable) != 0) {
    throw std::invalid_argument(std::string("pixel format ") + (described != nullptr ? described->name : "unknown"));
  }
  const bool palette = (described->flags & AV_PIX_FMT_FLAG_PAL) != 0;
  const bool rgb = palette || (described->flags & AV_PIX_FMT_FLAG_RGB) != 0;
  const bool deep = !palette && described->comp[0].depth > 8;
  return native(rgb, nearest_chroma(*described), deep);
}

void describe_native(AVPixelFormat format, PixelFormat& out) {
  const AVPixFmtDescriptor* described = av_pix_fmt_desc_get(format);
  out.bit_depth = described->comp[0].depth;
  out.chroma = nearest_chroma(*described);
}

AVPixelFormat native_format(const PixelFormat& format) {
  return native(format.color.matrix == ColorMatrix::Rgb, format.chroma, format.bit_depth > 8);
}

}  // namespace ar
