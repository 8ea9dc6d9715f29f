#pragma once

// Clips that tests make for themselves: pictures with known samples, written by the sink and read back by the source.

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "ar/capture/file/open_source.h"
#include "ar/output/sink.h"

namespace ar::testing {

// A folder of its own that goes away with the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  // Names of everything inside, hidden things too, sorted.
  std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

inline constexpr ColorInfo kHd{ColorMatrix::Bt709, ColorRange::Limited, Transfer::Bt709, Primaries::Bt709,
                               ChromaSiting::Left};
inline constexpr ColorInfo kRgb{ColorMatrix::Rgb, ColorRange::Full, Transfer::Srgb, Primaries::Bt709,
                                ChromaSiting::Center};

// Frames that come from no file: `path` empty, time base 1/1000, 25 frames a second.
SourceInfo made_source(int width, int height, Chroma chroma = Chroma::C420, int bit_depth = 8,
                       const ColorInfo& color = kHd);

// The samples of the three planes without padding, in words of the format's width.
using Samples = std::vector<std::vector<std::uint16_t>>;

// A picture with detail in every plane that differs from one `number` to the next; legal in limited range.
Samples made_picture(const PixelFormat& format, int number);
void fill(const OutputFrame& frame, const Samples& samples);
Samples samples_of(const Frame& frame);

// Writes frame i as made_picture(i) at pts[i] and finishes.
void write_clip(const std::filesystem::path& path, const SourceInfo& info, const std::vector<std::int64_t>& pts,
                const VideoSinkOptions& options = {});

struct ReadClip {
  SourceInfo info;
  std::vector<std::int64_t> pts;
  std::vector<double> time_s;
  std::vector<double> duration_s;
  std::vector<Samples> pictures;
  std::int64_t damaged = 0;
};
ReadClip read_clip(const std::string& path, const OpenOptions& options = {});

// Reads `in` and hands each of its frames on untouched to `out`.
void copy_clip(const std::string& in, const std::filesystem::path& out, const VideoSinkOptions& options = {});

// The greatest absolute difference between two pictures of one format.
int greatest_difference(const Samples& a, const Samples& b);

// Runs a program of the shell and returns what it prints; fails the test where its status is not 0.
std::string run(const std::string& command);

}  // namespace ar::testing
