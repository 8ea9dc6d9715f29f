#include "ar/output/stream_copy.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <string>

#include "ar/error.h"

namespace ar {
namespace {

std::string describe(const AVStream& stream) {
  const char* kind = av_get_media_type_string(stream.codecpar->codec_type);
  return fmt::format("{} stream {} ({})", kind != nullptr ? kind : "unknown", stream.index,
                     avcodec_get_name(stream.codecpar->codec_id));
}

bool is_copied_kind(const AVStream& stream) {
  const AVMediaType kind = stream.codecpar->codec_type;
  return kind == AVMEDIA_TYPE_AUDIO || kind == AVMEDIA_TYPE_SUBTITLE;
}

std::int64_t start_of(const AVPacket& packet) {
  return packet.pts != AV_NOPTS_VALUE ? packet.pts : packet.dts;
}

}  // namespace

StreamCopy::StreamCopy(const std::filesystem::path& source, AVFormatContext& muxer, bool copy_streams) {
  AVFormatContext* opened = nullptr;
  int code = avformat_open_input(&opened, ("file:" + source.string()).c_str(), nullptr, nullptr);
  source_.reset(opened);
  if (code >= 0) code = avformat_find_stream_info(opened, nullptr);
  const int index = code >= 0 ? av_find_best_stream(opened, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0) : code;
  if (index < 0) {
    throw InputError(
        fmt::format("cannot read {} again for its sound: {}\nLeave the file in place while it is processed.",
                    source.string(), ffmpeg::error_text(index)));
  }
  video_ = opened->streams[index];
  // Containers without edit lists would shift everything to make the first timestamp zero.
  keep_negative_ = (muxer.oformat->flags & AVFMT_TS_NEGATIVE) != 0;
  if (copy_streams) add_streams(muxer);
}

void StreamCopy::add_streams(AVFormatContext& muxer) {
  for (unsigned i = 0; i < source_->nb_streams; ++i) {
    AVStream& from = *source_->streams[i];
    if (&from == video_) continue;
    const bool fits =
        is_copied_kind(from) && avformat_query_codec(muxer.oformat, from.codecpar->codec_id, FF_COMPLIANCE_NORMAL) == 1;
    if (!fits) {
      const std::string name = std::filesystem::path(source_->url).filename().string();
      spdlog::warn("{}: {} is left out: {} cannot hold it", name, describe(from), muxer.oformat->name);
      from.discard = AVDISCARD_ALL;
      continue;
    }
    AVStream* to = avformat_new_stream(&muxer, nullptr);
    if (to == nullptr || avcodec_parameters_copy(to->codecpar, from.codecpar) < 0) throw std::bad_alloc();
    to->codecpar->codec_tag = 0;  // the new container has its own
    to->time_base = from.time_base;
    to->disposition = from.disposition;
    av_dict_copy(&to->metadata, from.metadata, 0);
    routes_.push_back({from.index, to});
  }
}

const StreamCopy::Route* StreamCopy::route_of(int input) const {
  const auto found = std::find_if(routes_.begin(), routes_.end(), [&](const Route& r) { return r.input == input; });
  return found != routes_.end() ? &*found : nullptr;
}

void StreamCopy::begin_at(std::int64_t pts) {
  origin_ = pts;
  if (video_->start_time != AV_NOPTS_VALUE && pts > video_->start_time) begin_ = pts;
}

ffmpeg::PacketPtr StreamCopy::read() {
  if (waiting_) return std::move(waiting_);
  ffmpeg::PacketPtr packet = ffmpeg::make_packet();
  while (av_read_frame(source_.get(), packet.get()) >= 0) {
    if (route_of(packet->stream_index) != nullptr) return packet;
    const bool shown = packet->stream_index == video_->index && (packet->flags & AV_PKT_FLAG_DISCARD) == 0;
    if (shown && start_of(*packet) != AV_NOPTS_VALUE) video_read_ = std::max(video_read_, start_of(*packet));
    av_packet_unref(packet.get());
  }
  return nullptr;
}

bool StreamCopy::before(const AVPacket& packet, std::int64_t video_pts) const {
  const AVRational time_base = source_->streams[packet.stream_index]->time_base;
  return av_compare_ts(start_of(packet), time_base, video_pts, video_->time_base) < 0;
}

void StreamCopy::hand_on(AVPacket& packet, const PacketTaker& take) const {
  const Route& route = *route_of(packet.stream_index);
  if (start_of(packet) == AV_NOPTS_VALUE) return;
  if (begin_ && before(packet, *begin_)) return;
  const AVRational time_base = source_->streams[packet.stream_index]->time_base;
  const std::int64_t shift = av_rescale_q(origin_, video_->time_base, time_base);
  if (packet.pts != AV_NOPTS_VALUE) packet.pts -= shift;
  if (packet.dts != AV_NOPTS_VALUE) packet.dts -= shift;
  if (!keep_negative_ && start_of(packet) < 0) return;  // encoder's run-in, which no player sounds
  av_packet_rescale_ts(&packet, time_base, route.output->time_base);
  packet.stream_index = route.output->index;
  packet.pos = -1;
  take(packet);
}

void StreamCopy::copy_until(std::int64_t pts, const PacketTaker& take) {
  if (routes_.empty()) return;
  while (ffmpeg::PacketPtr packet = read()) {
    if (!before(*packet, pts)) {
      waiting_ = std::move(packet);
      return;
    }
    hand_on(*packet, take);
  }
}

void StreamCopy::finish(std::int64_t last_pts, std::int64_t end_pts, const PacketTaker& take) {
  if (routes_.empty()) return;
  // Files interleave their streams loosely: sound of a moment may lie some seconds behind its picture.
  const std::int64_t far_beyond = end_pts + av_rescale_q(10, {1, 1}, video_->time_base);
  std::vector<ffmpeg::PacketPtr> after_end;
  while (ffmpeg::PacketPtr packet = read()) {
    const bool cut_short = video_read_ > last_pts;
    if (before(*packet, end_pts)) {
      hand_on(*packet, take);
    } else if (!cut_short) {
      after_end.push_back(std::move(packet));
    } else {
      video_->discard = AVDISCARD_ALL;  // nothing more to learn from it
      if (!before(*packet, far_beyond)) break;
    }
  }
  if (video_read_ > last_pts) return;
  for (const ffmpeg::PacketPtr& packet : after_end) hand_on(*packet, take);
}

}  // namespace ar
