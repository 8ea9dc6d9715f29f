#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "ar/capture/source.h"

namespace ar {

// A frame on its way out: planes that the sink owns and the renderer fills.
struct OutputFrame {
  PixelFormat format;
  std::array<std::uint8_t*, 3> plane{};
  std::array<std::ptrdiff_t, 3> stride_bytes{};
  std::shared_ptr<void> owner;
};

// Takes finished frames in order of presentation.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  // A buffer to render into.
  virtual OutputFrame allocate() = 0;
  // `frame` is from allocate(); `pts` in the source's time base, rising (std::invalid_argument otherwise). Throws
  // std::runtime_error when it cannot be written (disk full names the file).
  virtual void write(OutputFrame frame, std::int64_t pts) = 0;
  // Hands an untouched source frame on, at its own timestamp, without copying it.
  virtual void write_untouched(Frame frame) = 0;
  // Finalises, renames to the final name. Without it nothing appears under the final name.
  virtual void finish() = 0;
};

enum class VideoCodec { H264, Hevc, Ffv1 };

struct VideoSinkOptions {
  VideoCodec codec = VideoCodec::H264;
  int crf = 18;                   // H.264 and HEVC
  std::string preset = "medium";  // x264's and x265's name
  bool overwrite = false;
  bool copy_other_streams = true;  // audio and subtitles, from the source file
  int threads = 0;                 // of the encoder, 0: as many as the machine has
  // For what is recorded as it happens: under the final name from its first second on (what is there already is lost
  // then), in pieces that are playable by themselves, so that a killed process leaves all but the last second. No frame
  // waits in the encoder for later ones.
  bool live = false;
};

// A video file (.mp4, .m4v, .mov, .mkv) or PNG pictures: one ("still.png", takes one frame), or as many as come,
// numbered from 0 ("shot_%04d.png"). Frames have the source's size, chroma, depth, colour tags, sample aspect, time
// base and timestamps, uneven ones included (MP4 and MOV exactly; Matroska counts in milliseconds), counted from the
// first frame written: the file begins at 0, however late the source's clock or the part that is taken. H.264 and HEVC
// take RGB frames as 4:2:0 BT.709 and odd sizes as 4:4:4; FFV1 (.mkv) keeps everything bit for bit.
//
// `source` is as open_source() gave it: the audio and subtitle streams and the metadata of `source.path` are copied. Or
// it is made by hand: then `source.path` stays empty and `source.tags` unset; format (color included), time_base,
// frame_rate and sample_aspect say what is written, and `source.recorded` becomes creation time and location.
//
// Unless `live`, everything is written beside the final name, under a hidden temporary one, and renamed by finish().
// Destroyed without finish(), it removes that; a killed process leaves it, and the final name as it was. When frames
// stop before the source's end, or begin after its start, its sound is cut to match. Throws std::runtime_error: exists
// and not overwrite (before anything is written), no such folder, unknown container, container or codec cannot hold it.
std::unique_ptr<FrameSink> make_file_sink(const std::filesystem::path& path, const SourceInfo& source,
                                          const VideoSinkOptions& options = {});

}  // namespace ar
