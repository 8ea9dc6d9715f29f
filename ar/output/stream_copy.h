#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "ar/capture/ffmpeg.h"

namespace ar {

// Copies a file's sound and subtitle packets, unchanged and in step with its pictures, into a muxer beside its new
// video, and its metadata. Reads the file a second time, as far as the video has come.
class StreamCopy {
 public:
  // Takes a packet whose stream index and time base are the muxer's.
  using PacketTaker = std::function<void(AVPacket&)>;

  // Opens `source` and gives `muxer` (header not yet written) a stream for each one that its container can hold; the
  // others are named in a warning. Throws InputError where the file can no longer be read.
  StreamCopy(const std::filesystem::path& source, AVFormatContext& muxer, bool copy_streams);

  // The source's metadata of the whole file and of its video stream.
  const AVDictionary* file_metadata() const { return source_->metadata; }
  const AVStream& video() const { return *video_; }

  // The first timestamp of the video that is written, in its own time base, and becomes time 0: of a part of the video
  // that does not begin at its start, earlier sound is left out.
  void begin_at(std::int64_t pts);
  // Hands on what lies before the time `pts` of the video.
  void copy_until(std::int64_t pts, const PacketTaker& take);
  // Hands on the rest: to the source's end if the frame at `last_pts` was its last, else what begins before `end_pts`,
  // the end of that frame.
  void finish(std::int64_t last_pts, std::int64_t end_pts, const PacketTaker& take);

 private:
  struct Route {
    int input = -1;
    AVStream* output = nullptr;  // of the muxer
  };

  void add_streams(AVFormatContext& muxer);
  const Route* route_of(int input) const;
  // The next packet of a copied stream; nothing at the end or at damage. Notes how far the video reaches.
  ffmpeg::PacketPtr read();
  bool before(const AVPacket& packet, std::int64_t video_pts) const;
  void hand_on(AVPacket& packet, const PacketTaker& take) const;

  ffmpeg::DemuxerPtr source_;
  AVStream* video_ = nullptr;  // of source_
  std::vector<Route> routes_;
  std::int64_t origin_ = 0;  // of the video's timestamps, which becomes 0
  std::optional<std::int64_t> begin_;
  bool keep_negative_ = true;
  std::int64_t video_read_ = INT64_MIN;  // greatest timestamp of a video packet met
  ffmpeg::PacketPtr waiting_;            // read, but of a later time than the video has come to
};

}  // namespace ar
