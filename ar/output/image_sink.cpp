#include "ar/output/image_sink.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "ar/capture/color/color.h"
#include "ar/capture/file/image_list.h"
#include "render/base/whole_file.h"

namespace ar {
namespace {

namespace fs = std::filesystem;

std::runtime_error failure(const fs::path& path, const std::string& what) {
  return std::runtime_error(fmt::format("cannot write {}: {}", path.string(), what));
}

ConvertedFormat png_format(const PixelFormat& format) {
  const ColorTags tags = tags_from_color(format.color);
  return {format.bit_depth > 8 ? AV_PIX_FMT_RGB48BE : AV_PIX_FMT_RGB24,
          format.width,
          format.height,
          AVCOL_RANGE_JPEG,
          static_cast<AVColorSpace>(tags.matrix),
          ""};
}

}  // namespace

ImageSink::ImageSink(const fs::path& path, const SourceInfo& source, const VideoSinkOptions& options)
    : path_(path),
      numbered_(is_printf_pattern(path.string())),
      format_(source.format),
      overwrite_(options.overwrite),
      folder_(path, options.overwrite),
      pool_(source.format),
      converter_(png_format(source.format), options.threads) {
  ffmpeg::route_log();
  const AVCodec* png = avcodec_find_encoder(AV_CODEC_ID_PNG);
  if (png == nullptr) throw failure(path_, "this FFmpeg writes no PNG");
  encoder_.reset(avcodec_alloc_context3(png));
  if (!encoder_) throw std::bad_alloc();
  encoder_->width = format_.width;
  encoder_->height = format_.height;
  encoder_->pix_fmt = converter_.target().format;
  encoder_->time_base = {1, 1};
  encoder_->color_range = AVCOL_RANGE_JPEG;
  encoder_->thread_count = 1;  // each picture is out before the next comes in
  const ColorTags tags = source.tags.value_or(tags_from_color(source.format.color));
  encoder_->color_primaries = static_cast<AVColorPrimaries>(tags.primaries);
  encoder_->color_trc = static_cast<AVColorTransferCharacteristic>(tags.transfer);
  encoder_->sample_aspect_ratio = {source.sample_aspect.num, source.sample_aspect.den};
  if (const int code = avcodec_open2(encoder_.get(), png, nullptr); code < 0) {
    throw failure(path_, ffmpeg::error_text(code));
  }
  std::error_code error;
  if (!fs::create_directory(folder_.path(), error)) throw failure(path_, error.message());
}

fs::path ImageSink::final_name(std::int64_t number) const {
  return numbered_ ? fs::path(printf_name(path_.string(), number)) : path_;
}

void ImageSink::save(const AVPacket& packet) const {
  const fs::path name = folder_.path() / final_name(count_).filename();
  std::ofstream out(name, std::ios::binary);
  out.write(reinterpret_cast<const char*>(packet.data), packet.size);
  out.close();
  if (!out) throw failure(final_name(count_), std::error_code(errno, std::generic_category()).message());
}

void ImageSink::encode(ffmpeg::FramePtr picture) {
  if (!numbered_ && count_ > 0) {
    throw failure(path_, "the name is of one picture, but more frames came\nNumber them: shot_%04d.png.");
  }
  picture = converter_.convert(std::move(picture));
  ffmpeg::PacketPtr packet = ffmpeg::make_packet();
  picture->pts = count_;
  picture->pict_type = AV_PICTURE_TYPE_NONE;
  int code = avcodec_send_frame(encoder_.get(), picture.get());
  if (code >= 0) code = avcodec_receive_packet(encoder_.get(), packet.get());
  if (code < 0) throw failure(final_name(count_), ffmpeg::error_text(code));
  save(*packet);
  ++count_;
}

void ImageSink::write(OutputFrame frame, std::int64_t /*pts*/) {
  check_format(frame.format, format_);
  encode(picture_of(frame));
}

void ImageSink::write_untouched(Frame frame) {
  check_format(frame.format, format_);
  encode(picture_of(std::move(frame), pool_));
}

void ImageSink::finish() {
  for (std::int64_t i = 0; i < count_; ++i) {
    const fs::path to = final_name(i);
    try {
      render::rename_whole(folder_.path() / to.filename(), to,
                           overwrite_ ? render::Existing::Replace : render::Existing::Keep);
    } catch (const std::system_error& error) {
      throw failure(to, error.code().message());
    }
  }
}

}  // namespace ar
