#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "ar/capture/frame.h"

namespace ar {

struct Rational {
  int num = 0;
  int den = 1;
};

// Where and when a recording was made, as far as its metadata tells: creation time and ISO 6709 location of a video,
// GPS position and time in a picture's EXIF. Some phones stamp a video's end, not its first frame.
struct RecordedAt {
  std::optional<double> latitude_deg;
  std::optional<double> longitude_deg;
  std::optional<double> height_m;
  std::optional<std::chrono::sys_time<std::chrono::microseconds>> time;  // of the first frame, UTC
};

// What a stream of frames is. Filled by a source; or by hand for frames that are made, not read (then `path` stays
// empty, `tags` unset, and `format.color`, `time_base`, `frame_rate` and `recorded` say what the sink writes).
struct SourceInfo {
  std::string name;  // file or device, for messages
  // The file whose audio, subtitles and metadata a sink copies; empty where there is none (pictures, made frames).
  std::filesystem::path path;
  PixelFormat format;  // color complete: what no tag told was guessed by guess_color() and logged
  // The colour tags exactly as the stream has them, unspecified ones included, for the sink to repeat; unset: the sink
  // writes `format.color`.
  std::optional<ColorTags> tags;
  Rational time_base{1, 1000};
  Rational frame_rate{0, 1};                // 0: unknown
  Rational sample_aspect{1, 1};             // of the upright picture
  std::optional<std::int64_t> frame_count;  // as the container tells, for progress; may be wrong
  std::optional<double> duration_s;
  int rotation_deg =
      0;  // rotation that was applied, clockwise: 0, 90, 180, 270 (of a mirrored picture: after mirroring)
  RecordedAt recorded;
  std::string codec;
};

// A stream of upright frames.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual const SourceInfo& info() const = 0;
  // The next frame, or nothing at the end. A damaged part inside is skipped, counted and logged; throws InputError
  // when nothing more can be read although the container promises more (truncation is logged, not thrown).
  virtual std::optional<Frame> next() = 0;
  // Packets and frames so far that were damaged: lost, or shown as far as the decoder could conceal it.
  virtual std::int64_t damaged() const { return 0; }
};

}  // namespace ar
