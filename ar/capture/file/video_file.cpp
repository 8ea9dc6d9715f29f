#include "ar/capture/file/video_file.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "ar/capture/file/metadata.h"
#include "ar/error.h"

namespace ar {
namespace {

ffmpeg::FramePtr first_picture(Decoder& decoder) {
  ffmpeg::FramePtr picture = decoder.next();
  if (!picture) {
    throw InputError(
        fmt::format("cannot read {}: no frame of its video could be decoded\nThe file is damaged or cut short; "
                    "copy it again.",
                    decoder.name()));
  }
  return picture;
}

std::optional<double> duration_of(const Decoder& decoder) {
  const AVStream& stream = decoder.stream();
  if (stream.duration != AV_NOPTS_VALUE) return static_cast<double>(stream.duration) * av_q2d(stream.time_base);
  if (decoder.container().duration != AV_NOPTS_VALUE) {
    return static_cast<double>(decoder.container().duration) / AV_TIME_BASE;
  }
  return std::nullopt;
}

}  // namespace

VideoFile::VideoFile(const std::filesystem::path& path, const OpenOptions& options)
    : decoder_(path, path.string(), options.threads),
      pending_(first_picture(decoder_)),
      maker_(*pending_, &decoder_.stream(), decoder_.name(), options) {
  info_.path = path;
  describe();
}

void VideoFile::describe() {
  AVStream& stream = decoder_.stream();
  maker_.describe(info_);
  info_.name = decoder_.name();
  info_.codec = avcodec_get_name(stream.codecpar->codec_id);
  info_.time_base = {stream.time_base.num, stream.time_base.den};
  const AVRational rate = av_guess_frame_rate(nullptr, &stream, nullptr);
  info_.frame_rate = {rate.num, std::max(rate.den, 1)};
  if (rate.num > 0) usual_duration_ = std::max<std::int64_t>(1, av_rescale_q(1, av_inv_q(rate), stream.time_base));
  info_.duration_s = duration_of(decoder_);
  if (stream.nb_frames > 0) {
    info_.frame_count = stream.nb_frames;
  } else if (info_.duration_s && rate.num > 0) {
    info_.frame_count = std::llround(*info_.duration_s * av_q2d(rate));
  }
  info_.recorded = merge(merge(recorded_at(decoder_.container().metadata), recorded_at(stream.metadata)),
                         recorded_at(pending_->metadata));
  if (pending_->interlaced_frame != 0) {
    spdlog::warn("{}: interlaced; its frames are taken as they are, combed where things move", info_.name);
  }
}

// The picture's own timestamp; where it has none, or one that runs backwards (both happen in broken files), the next
// that fits, since trackers and containers need time to run forward.
std::int64_t VideoFile::timestamp_of(const AVFrame& picture) {
  std::int64_t pts = picture.best_effort_timestamp;
  if (pts == AV_NOPTS_VALUE) return frames_ == 0 ? 0 : last_pts_ + usual_duration_;
  if (frames_ > 0 && pts <= last_pts_) {
    if (mistimed_++ == 0) {
      spdlog::warn("{}: time runs backwards at frame {}; such frames follow the one before at once", info_.name,
                   frames_);
    }
    pts = last_pts_ + 1;
  }
  return pts;
}

std::optional<Frame> VideoFile::next() {
  ffmpeg::FramePtr picture = pending_ ? std::move(pending_) : decoder_.next();
  if (!picture) return std::nullopt;
  const std::int64_t pts = timestamp_of(*picture);
  const std::int64_t duration = picture->pkt_duration > 0 ? picture->pkt_duration : usual_duration_;
  Frame frame = maker_.make(std::move(picture));
  const double tick_s = static_cast<double>(info_.time_base.num) / info_.time_base.den;
  frame.index = frames_++;
  frame.pts = last_pts_ = pts;
  frame.time_s = static_cast<double>(pts) * tick_s;
  frame.duration_s = static_cast<double>(duration) * tick_s;
  return frame;
}

}  // namespace ar
