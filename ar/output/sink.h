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
  // `pts` in the source's time base. Throws std::runtime_error when it cannot be written (disk full names the file).
  virtual void write(OutputFrame frame, std::int64_t pts) = 0;
  // Hands an untouched source frame on without copying it.
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
  int threads = 0;
};

// A video file (container by the extension) or, with a printf pattern ending in .png, an image sequence. Frames have
// the source's size, chroma, depth, colour tags, sample aspect, time base and timestamps. Written beside the final name
// and renamed by finish(). Throws std::runtime_error: exists and not overwrite, no such folder, container cannot hold
// it.
std::unique_ptr<FrameSink> make_file_sink(const std::filesystem::path& path, const SourceInfo& source,
                                          const VideoSinkOptions& options = {});

}  // namespace ar
