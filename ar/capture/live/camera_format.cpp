#include "ar/capture/live/camera_format.h"

#include <linux/videodev2.h>

extern "C" {
#include <libavutil/imgutils.h>
#include <libavutil/pixdesc.h>
}

#include <array>
#include <new>

namespace ar {
namespace {

// In the order of preference: planes as they are used, then what is split fast, then what is decoded; colour lost last.
constexpr std::array<CameraFormat, 11> kFormats{{
    {"YU12", AV_PIX_FMT_YUV420P, AV_CODEC_ID_NONE},
    {"YM12", AV_PIX_FMT_YUV420P, AV_CODEC_ID_NONE},  // the same with each plane in memory of its own
    {"NV12", AV_PIX_FMT_NV12, AV_CODEC_ID_NONE},
    {"NM12", AV_PIX_FMT_NV12, AV_CODEC_ID_NONE},
    {"YUYV", AV_PIX_FMT_YUYV422, AV_CODEC_ID_NONE},
    {"UYVY", AV_PIX_FMT_UYVY422, AV_CODEC_ID_NONE},
    {"RGB3", AV_PIX_FMT_RGB24, AV_CODEC_ID_NONE},
    {"BGR3", AV_PIX_FMT_BGR24, AV_CODEC_ID_NONE},
    {"MJPG", AV_PIX_FMT_NONE, AV_CODEC_ID_MJPEG},
    {"JPEG", AV_PIX_FMT_NONE, AV_CODEC_ID_MJPEG},
    {"GREY", AV_PIX_FMT_GRAY8, AV_CODEC_ID_NONE},
}};

AVColorPrimaries primaries_of(std::uint32_t colorspace) {
  switch (colorspace) {
    case V4L2_COLORSPACE_SMPTE170M:
      return AVCOL_PRI_SMPTE170M;
    case V4L2_COLORSPACE_SMPTE240M:
      return AVCOL_PRI_SMPTE240M;
    case V4L2_COLORSPACE_REC709:
    case V4L2_COLORSPACE_SRGB:
    case V4L2_COLORSPACE_JPEG:
      return AVCOL_PRI_BT709;
    case V4L2_COLORSPACE_470_SYSTEM_M:
      return AVCOL_PRI_BT470M;
    case V4L2_COLORSPACE_470_SYSTEM_BG:
      return AVCOL_PRI_BT470BG;
    case V4L2_COLORSPACE_BT2020:
      return AVCOL_PRI_BT2020;
    case V4L2_COLORSPACE_DCI_P3:
      return AVCOL_PRI_SMPTE431;
    default:
      return AVCOL_PRI_UNSPECIFIED;
  }
}

AVColorTransferCharacteristic transfer_of(std::uint32_t transfer) {
  switch (transfer) {
    case V4L2_XFER_FUNC_709:
      return AVCOL_TRC_BT709;
    case V4L2_XFER_FUNC_SRGB:
      return AVCOL_TRC_IEC61966_2_1;
    case V4L2_XFER_FUNC_SMPTE240M:
      return AVCOL_TRC_SMPTE240M;
    case V4L2_XFER_FUNC_NONE:
      return AVCOL_TRC_LINEAR;
    case V4L2_XFER_FUNC_SMPTE2084:
      return AVCOL_TRC_SMPTE2084;
    default:
      return AVCOL_TRC_UNSPECIFIED;
  }
}

AVColorSpace matrix_of(std::uint32_t encoding) {
  switch (encoding) {
    case V4L2_YCBCR_ENC_601:
    case V4L2_YCBCR_ENC_XV601:
      return AVCOL_SPC_SMPTE170M;
    case V4L2_YCBCR_ENC_709:
    case V4L2_YCBCR_ENC_XV709:
      return AVCOL_SPC_BT709;
    case V4L2_YCBCR_ENC_BT2020:
      return AVCOL_SPC_BT2020_NCL;
    case V4L2_YCBCR_ENC_SMPTE240M:
      return AVCOL_SPC_SMPTE240M;
    default:
      return AVCOL_SPC_UNSPECIFIED;
  }
}

}  // namespace

std::optional<CameraFormat> find_camera_format(const std::string& name) {
  for (const CameraFormat& format : kFormats) {
    if (format.name == name) return format;
  }
  return std::nullopt;
}

int camera_format_rank(const std::string& name) {
  int rank = 0;
  for (const CameraFormat& format : kFormats) {
    if (format.name == name) break;
    ++rank;
  }
  return rank;
}

std::uint32_t fourcc_code(const std::string& name) {
  std::string four = name.substr(0, 4);
  four.resize(4, ' ');
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(four[i])); };
  const bool big_endian = name.size() == 7 && name.ends_with("-BE");
  return v4l2_fourcc(byte(0), byte(1), byte(2), byte(3)) | (big_endian ? 1U << 31U : 0U);
}

std::string fourcc_name(std::uint32_t code) {
  std::string name;
  for (unsigned shift = 0; shift < 32; shift += 8) name += static_cast<char>((code >> shift) & 0x7fU);
  if ((code >> 31U) != 0) return name + "-BE";
  return name;
}

std::size_t PictureLayout::bytes() const {
  const AVPixFmtDescriptor* described = av_pix_fmt_desc_get(pixels);
  const auto rows = static_cast<std::size_t>(height);
  const auto stride = static_cast<std::size_t>(stride_bytes);
  if (av_pix_fmt_count_planes(pixels) == 1) return rows * stride;
  // Two planes with both chromas side by side, or three with rows of half the length: the same number of bytes.
  const std::size_t chroma_rows = (rows + (std::size_t{1} << described->log2_chroma_h) - 1) >> described->log2_chroma_h;
  return rows * stride + chroma_rows * stride;
}

ffmpeg::FramePtr picture_on(const PictureLayout& layout, AVBufferRef* memory) {
  ffmpeg::FramePtr picture = ffmpeg::make_frame();
  picture->format = layout.pixels;
  picture->width = layout.width;
  picture->height = layout.height;
  const int planes = av_pix_fmt_count_planes(layout.pixels);
  picture->linesize[0] = layout.stride_bytes;
  picture->linesize[1] = planes == 3 ? layout.stride_bytes / 2 : layout.stride_bytes;
  picture->linesize[2] = picture->linesize[1];
  const AVPixFmtDescriptor* described = av_pix_fmt_desc_get(layout.pixels);
  const int chroma_rows = (layout.height + (1 << described->log2_chroma_h) - 1) >> described->log2_chroma_h;
  picture->data[0] = memory->data;
  for (int i = 1; i < planes; ++i) {
    const int rows = i == 1 ? layout.height : chroma_rows;
    picture->data[i] = picture->data[i - 1] + static_cast<std::ptrdiff_t>(rows) * picture->linesize[i - 1];
  }
  picture->buf[0] = av_buffer_ref(memory);
  if (picture->buf[0] == nullptr) throw std::bad_alloc();
  return picture;
}

void tag_colors(const v4l2_pix_format& described, AVFrame& picture) {
  const std::uint32_t colorspace = described.colorspace;
  const bool unknown = colorspace == V4L2_COLORSPACE_DEFAULT || colorspace == V4L2_COLORSPACE_RAW;
  const bool rgb = (av_pix_fmt_desc_get(static_cast<AVPixelFormat>(picture.format))->flags & AV_PIX_FMT_FLAG_RGB) != 0;
  std::uint32_t transfer = described.xfer_func;
  std::uint32_t encoding = described.ycbcr_enc;
  std::uint32_t range = described.quantization;
  if (!unknown) {
    if (transfer == V4L2_XFER_FUNC_DEFAULT) transfer = V4L2_MAP_XFER_FUNC_DEFAULT(colorspace);
    if (encoding == V4L2_YCBCR_ENC_DEFAULT) encoding = V4L2_MAP_YCBCR_ENC_DEFAULT(colorspace);
    if (range == V4L2_QUANTIZATION_DEFAULT) range = V4L2_MAP_QUANTIZATION_DEFAULT(rgb, colorspace, encoding);
  }
  picture.color_primaries = primaries_of(colorspace);
  picture.color_trc = transfer_of(transfer);
  picture.colorspace = rgb ? AVCOL_SPC_RGB : matrix_of(encoding);
  // Sensors without colour give their whole range, and vivid does so too, whatever the default says.
  if (picture.format == AV_PIX_FMT_GRAY8 && described.quantization == V4L2_QUANTIZATION_DEFAULT) {
    range = V4L2_QUANTIZATION_FULL_RANGE;
  }
  if (range == V4L2_QUANTIZATION_FULL_RANGE) picture.color_range = AVCOL_RANGE_JPEG;
  if (range == V4L2_QUANTIZATION_LIM_RANGE) picture.color_range = AVCOL_RANGE_MPEG;
}

}  // namespace ar
