#include "ar/capture/v4l2/mjpeg_decoder.h"

#include <algorithm>
#include <new>

#include "ar/error.h"

namespace ar {

MjpegDecoder::MjpegDecoder() : packet_(ffmpeg::make_packet()) {
  ffmpeg::route_log();
  const AVCodec* decoder = avcodec_find_decoder(AV_CODEC_ID_MJPEG);
  if (decoder != nullptr) codec_.reset(avcodec_alloc_context3(decoder));
  // A picture that ends early is otherwise filled up in silence.
  if (codec_) codec_->err_recognition = AV_EF_EXPLODE;
  // Each picture is needed before the next one comes: no threads that would hold it back.
  if (codec_) codec_->thread_count = 1;
  if (!codec_ || avcodec_open2(codec_.get(), decoder, nullptr) < 0) {
    throw InputError("cannot decode the camera's pictures: this FFmpeg has no MJPEG decoder\nAsk for a raw format.");
  }
}

ffmpeg::FramePtr MjpegDecoder::decode(std::span<const std::uint8_t> jpeg) {
  if (av_new_packet(packet_.get(), static_cast<int>(jpeg.size())) < 0) throw std::bad_alloc();
  std::copy(jpeg.begin(), jpeg.end(), packet_->data);
  const int sent = avcodec_send_packet(codec_.get(), packet_.get());
  av_packet_unref(packet_.get());
  ffmpeg::FramePtr picture = ffmpeg::make_frame();
  const bool decoded = sent >= 0 && avcodec_receive_frame(codec_.get(), picture.get()) >= 0;
  if (decoded && picture->decode_error_flags == 0) return picture;
  ffmpeg::last_complaint();
  return nullptr;
}

}  // namespace ar
