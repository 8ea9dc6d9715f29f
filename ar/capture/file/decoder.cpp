#include "ar/capture/file/decoder.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <array>
#include <fstream>
#include <string_view>

#include "ar/error.h"

namespace ar {
namespace {

constexpr const char* kHint =
    "Give a video (mp4, mov, mkv, avi, webm, ...), a picture, a folder or a pattern of pictures.";

std::string reason(int code) {
  const std::string complaint = ffmpeg::last_complaint();
  return complaint.empty() ? ffmpeg::error_text(code) : complaint;
}

[[noreturn]] void refuse(const std::string& name, const std::string& what, const char* hint = kHint) {
  throw InputError(fmt::format("cannot read {}: {}\n{}", name, what, hint));
}

// Text that FFmpeg would show as pictures of letters.
bool is_text_art(AVCodecID codec) {
  return codec == AV_CODEC_ID_ANSI || codec == AV_CODEC_ID_BINTEXT || codec == AV_CODEC_ID_XBIN ||
         codec == AV_CODEC_ID_IDF;
}

// Whether the first box is one that MP4 and QuickTime files begin with (ISO 14496-12, 4.2: size, then type).
bool begins_like_mp4(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 8> head{};
  in.read(head.data(), head.size());
  const std::string_view type(head.data() + 4, 4);
  return in && (type == "ftyp" || type == "moov" || type == "mdat" || type == "wide" || type == "free");
}

void check_file(const std::filesystem::path& path, const std::string& name) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) refuse(name, "no such file");
  if (std::filesystem::is_regular_file(path, error) && std::filesystem::file_size(path, error) == 0) {
    refuse(name, "the file is empty (0 bytes)", "Copy or record it again.");
  }
}

}  // namespace

Decoder::Decoder(const std::filesystem::path& path, std::string name, int threads)
    : name_(std::move(name)), packet_(ffmpeg::make_packet()) {
  ffmpeg::route_log();
  check_file(path, name_);
  open_container(path);
  open_codec(threads);
}

void Decoder::open_container(const std::filesystem::path& path) {
  ffmpeg::last_complaint();
  AVFormatContext* opened = nullptr;
  // The protocol is named, so that no colon or scheme in a file's name means anything else.
  const int open = avformat_open_input(&opened, ("file:" + path.string()).c_str(), nullptr, nullptr);
  if (open < 0) {
    const std::string why = reason(open);
    if (begins_like_mp4(path)) {
      refuse(name_, why + ": the file is damaged or was cut short", "Copy it again, or repair it.");
    }
    refuse(name_, why + ": not a video or picture");
  }
  container_.reset(opened);
  // Of a picture all is known once it is decoded; looking into it first would decode it twice.
  const std::string_view kind = opened->iformat->name;
  const bool picture = kind == "image2" || kind.ends_with("_pipe");
  if (const int found = picture ? 0 : avformat_find_stream_info(opened, nullptr); found < 0)
    refuse(name_, reason(found));
  const int index = av_find_best_stream(opened, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (index < 0) refuse(name_, "it holds no video stream");
  stream_ = opened->streams[index];
  // A sound file's cover is a picture, but not a video.
  if ((stream_->disposition & AV_DISPOSITION_ATTACHED_PIC) != 0 || is_text_art(stream_->codecpar->codec_id)) {
    refuse(name_, "it holds no video stream");
  }
  for (unsigned i = 0; i < opened->nb_streams; ++i) {
    if (opened->streams[i] != stream_) opened->streams[i]->discard = AVDISCARD_ALL;
  }
}

void Decoder::open_codec(int threads) {
  const AVCodecParameters& coded = *stream_->codecpar;
  const AVCodec* decoder = avcodec_find_decoder(coded.codec_id);
  if (decoder == nullptr) {
    refuse(name_, fmt::format("its codec {} is unknown here", avcodec_get_name(coded.codec_id)),
           "Convert it to H.264, HEVC or FFV1 first.");
  }
  codec_.reset(avcodec_alloc_context3(decoder));
  if (!codec_) throw std::bad_alloc();
  codec_->thread_count = threads;
  codec_->thread_type = FF_THREAD_FRAME | FF_THREAD_SLICE;
  codec_->err_recognition = AV_EF_CRCCHECK;
  codec_->pkt_timebase = stream_->time_base;
  int code = avcodec_parameters_to_context(codec_.get(), &coded);
  if (code >= 0) code = avcodec_open2(codec_.get(), decoder, nullptr);
  if (code < 0) refuse(name_, fmt::format("codec {}: {}", decoder->name, reason(code)));
}

void Decoder::note_damage(int code) {
  if (damaged_++ == 0) {
    spdlog::warn("{}: damaged after frame {} ({}); going on with what can be read", name_, frames_, reason(code));
  }
}

void Decoder::note_end() {
  ended_ = true;
  if (damaged_ > 1) spdlog::warn("{}: {} damaged packets or frames in all", name_, damaged_);
  const std::int64_t promised = stream_->nb_frames - left_out_;
  if (frames_ + damaged_ < promised) {
    spdlog::warn("{}: cut short: {} of {} frames could be read", name_, frames_, promised);
    damaged_ += promised - frames_ - damaged_;
  }
}

// Gives the decoder the next packet of the stream, or tells it that there is none.
void Decoder::feed() {
  for (;;) {
    const int code = av_read_frame(container_.get(), packet_.get());
    if (code == AVERROR(EIO)) refuse(name_, fmt::format("reading failed after frame {}: {}", frames_, reason(code)));
    if (code == AVERROR_EOF) break;
    if (code < 0) {
      note_damage(code);
      break;
    }
    const bool ours = packet_->stream_index == stream_->index;
    if (ours && (packet_->flags & AV_PKT_FLAG_DISCARD) != 0) ++left_out_;
    const int sent = ours ? avcodec_send_packet(codec_.get(), packet_.get()) : 0;
    av_packet_unref(packet_.get());
    if (sent < 0) note_damage(sent);
    if (ours && sent >= 0) return;
  }
  avcodec_send_packet(codec_.get(), nullptr);  // flush; a second flush is refused, harmlessly
}

ffmpeg::FramePtr Decoder::next() {
  ffmpeg::FramePtr frame = ffmpeg::make_frame();
  while (!ended_) {
    const int code = avcodec_receive_frame(codec_.get(), frame.get());
    if (code == 0) {
      ++frames_;
      if (frame->decode_error_flags != 0) note_damage(AVERROR_INVALIDDATA);
      return frame;
    }
    if (code == AVERROR(EAGAIN)) {
      feed();
    } else if (code == AVERROR_EOF) {
      note_end();
    } else {
      note_damage(code);
    }
  }
  return nullptr;
}

}  // namespace ar
