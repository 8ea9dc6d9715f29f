#include "ar/output/video_sink.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "ar/capture/file/metadata.h"

namespace ar {
namespace {

// Of these, the muxer writes its own.
constexpr const char* kContainersOwn[] = {"major_brand", "minor_version", "compatible_brands", "encoder"};

// Other containers know constant frame rates only, or would round or shift the times.
bool keeps_timestamps(const AVOutputFormat& container) {
  const std::string_view name = container.name;
  return name == "mp4" || name == "mov" || name == "matroska" || name == "ipod";
}

// A killed recording loses at most its last piece. Key frames, with which the pieces of MP4 begin, come as often.
constexpr int kPieceMs = 1000;

AVRational to_av(Rational value) {
  return {value.num, value.den};
}

}  // namespace

VideoSink::VideoSink(const std::filesystem::path& path, const SourceInfo& source, const VideoSinkOptions& options)
    : source_(source), live_(options.live), file_(path, options.overwrite, options.live), pool_(source.format) {
  ffmpeg::route_log();
  open_muxer();
  if (avformat_query_codec(muxer_->oformat, codec_id(options.codec), FF_COMPLIANCE_NORMAL) == 0) {
    throw std::runtime_error(fmt::format("cannot write {}: {} does not go into {} files\nUse .mkv, or another codec.",
                                         path.string(), codec_name(options.codec), path.extension().string()));
  }
  const bool global_header = (muxer_->oformat->flags & AVFMT_GLOBALHEADER) != 0;
  encoder_ = std::make_unique<Encoder>(source_, options, global_header, path.string());
  video_ = avformat_new_stream(muxer_.get(), nullptr);
  if (video_ == nullptr) throw std::bad_alloc();
  check(avcodec_parameters_from_context(video_->codecpar, &encoder_->context()), "cannot describe the video");
  video_->time_base = to_av(source_.time_base);
  video_->avg_frame_rate = to_av(source_.frame_rate);
  video_->sample_aspect_ratio = to_av(source_.sample_aspect);
  if (!source_.path.empty()) {
    others_ = std::make_unique<StreamCopy>(source_.path, *muxer_, options.copy_other_streams);
  }
  tag_file();
  write_header();
}

void VideoSink::open_muxer() {
  const std::string final_name = file_.final_path().string();
  const AVOutputFormat* container = av_guess_format(nullptr, final_name.c_str(), nullptr);
  if (container == nullptr || !keeps_timestamps(*container)) {
    throw std::runtime_error(
        fmt::format("cannot write {}: no container that keeps timestamps is called '{}'\nUse .mp4, .mkv or .mov.",
                    final_name, file_.final_path().extension().string()));
  }
  AVFormatContext* opened = nullptr;
  check(avformat_alloc_output_context2(&opened, container, nullptr, final_name.c_str()), "cannot set up the container");
  muxer_.reset(opened);
}

// What the source file says of itself, and, where it does not say when and where, what the caller knows.
void VideoSink::tag_file() {
  AVDictionary** tags = &muxer_->metadata;
  if (others_) {
    av_dict_copy(tags, others_->file_metadata(), 0);
    av_dict_copy(&video_->metadata, others_->video().metadata, 0);
    video_->disposition = others_->video().disposition;
  }
  for (const char* key : kContainersOwn) {
    av_dict_set(tags, key, nullptr, 0);
    av_dict_set(&video_->metadata, key, nullptr, 0);
  }
  const RecordedAt& at = source_.recorded;
  const RecordedAt known = recorded_at(*tags);
  if (at.time && !known.time) av_dict_set(tags, "creation_time", iso8601(*at.time).c_str(), 0);
  if (at.latitude_deg && at.longitude_deg && !known.latitude_deg) {
    av_dict_set(tags, "location", iso6709(*at.latitude_deg, *at.longitude_deg, at.height_m).c_str(), 0);
  }
}

void VideoSink::write_header() {
  check(avio_open(&muxer_->pb, ("file:" + file_.path().string()).c_str(), AVIO_FLAG_WRITE), "cannot create it");
  ffmpeg::Dictionary settings;
  if (live_) {
    // Other containers ignore what they do not know.
    settings.set("movflags", "frag_keyframe+empty_moov+default_base_moof");
    settings.set("cluster_time_limit", std::to_string(kPieceMs));
    muxer_->flags |= AVFMT_FLAG_FLUSH_PACKETS;
  }
  check(avformat_write_header(muxer_.get(), settings.out()), "cannot begin the file");
  if (live_) avio_flush(muxer_->pb);
}

void VideoSink::check(int code, const char* what) const {
  if (code >= 0) return;
  std::string reason = ffmpeg::error_text(code);
  if (const std::string complaint = ffmpeg::last_complaint(); !complaint.empty()) reason += " (" + complaint + ")";
  throw std::runtime_error(fmt::format("cannot write {}: {}: {}", file_.final_path().string(), what, reason));
}

void VideoSink::mux(AVPacket& packet) {
  check(av_interleaved_write_frame(muxer_.get(), &packet), "writing failed");
  check(muxer_->pb->error, "writing failed");
}

void VideoSink::mux_video(AVPacket& packet) {
  packet.stream_index = video_->index;
  av_packet_rescale_ts(&packet, to_av(source_.time_base), video_->time_base);
  mux(packet);
}

void VideoSink::encode(ffmpeg::FramePtr picture, std::int64_t pts) {
  if (last_pts_ && pts <= *last_pts_) {
    throw std::invalid_argument(fmt::format("timestamp {} does not follow {}", pts, *last_pts_));
  }
  if (!last_pts_) first_pts_ = pts;
  if (others_) {
    if (!last_pts_) others_->begin_at(pts);
    others_->copy_until(pts, [this](AVPacket& packet) { mux(packet); });
  }
  if (last_pts_) last_step_ = pts - *last_pts_;
  last_pts_ = pts;
  encoder_->encode(std::move(picture), pts - first_pts_, [this](AVPacket& packet) { mux_video(packet); });
}

void VideoSink::write(OutputFrame frame, std::int64_t pts) {
  check_format(frame.format, source_.format);
  encode(picture_of(frame), pts);
}

void VideoSink::write_untouched(Frame frame) {
  check_format(frame.format, source_.format);
  const std::int64_t pts = frame.pts;
  encode(picture_of(std::move(frame), pool_), pts);
}

void VideoSink::finish() {
  encoder_->flush([this](AVPacket& packet) { mux_video(packet); });
  if (others_ && last_pts_) {
    others_->finish(*last_pts_, *last_pts_ + last_step_, [this](AVPacket& packet) { mux(packet); });
  }
  check(av_write_trailer(muxer_.get()), "cannot end the file");
  check(muxer_->pb->error, "writing failed");
  check(avio_closep(&muxer_->pb), "cannot close it");
  file_.commit();
}

}  // namespace ar
