#include "tests/testing/made_clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace ar::testing {
namespace {

namespace fs = std::filesystem;

struct PlaneSize {
  int width = 0;
  int height = 0;
};

PlaneSize plane_size(const PixelFormat& format, std::size_t plane) {
  const bool chroma = plane > 0 && format.color.matrix != ColorMatrix::Rgb;
  const bool half_width = chroma && format.chroma != Chroma::C444;
  const bool half_height = chroma && format.chroma == Chroma::C420;
  return {half_width ? (format.width + 1) / 2 : format.width, half_height ? (format.height + 1) / 2 : format.height};
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "skyshaft-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

std::vector<std::string> TemporaryFolder::names() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

SourceInfo made_source(int width, int height, Chroma chroma, int bit_depth, const ColorInfo& color) {
  SourceInfo info;
  info.name = "made";
  info.format = {width, height, bit_depth, chroma, color};
  info.time_base = {1, 1000};
  info.frame_rate = {25, 1};
  return info;
}

Samples made_picture(const PixelFormat& format, int number) {
  Samples samples(3);
  const int scale = format.bit_depth > 8 ? 4 : 1;
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const PlaneSize size = plane_size(format, plane);
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        const int value = 40 + (3 * x + 5 * y + 7 * number + 31 * static_cast<int>(plane)) % 150;
        samples[plane].push_back(static_cast<std::uint16_t>(value * scale + (scale > 1 ? x % 4 : 0)));
      }
    }
  }
  return samples;
}

void fill(const OutputFrame& frame, const Samples& samples) {
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const PlaneSize size = plane_size(frame.format, plane);
    for (int y = 0; y < size.height; ++y) {
      std::uint8_t* row = frame.plane[plane] + y * frame.stride_bytes[plane];
      const std::uint16_t* from = samples[plane].data() + static_cast<std::ptrdiff_t>(y) * size.width;
      if (frame.format.bit_depth > 8) {
        std::memcpy(row, from, static_cast<std::size_t>(size.width) * 2);
      } else {
        for (int x = 0; x < size.width; ++x) row[x] = static_cast<std::uint8_t>(from[x]);
      }
    }
  }
}

Samples samples_of(const Frame& frame) {
  Samples samples(3);
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const PlaneSize size = plane_size(frame.format, plane);
    for (int y = 0; y < size.height; ++y) {
      const std::uint8_t* row = frame.plane[plane] + y * frame.stride_bytes[plane];
      for (int x = 0; x < size.width; ++x) {
        std::uint16_t value = row[x];
        if (frame.format.bit_depth > 8) std::memcpy(&value, row + std::ptrdiff_t{2} * x, 2);
        samples[plane].push_back(value);
      }
    }
  }
  return samples;
}

void write_clip(const fs::path& path, const SourceInfo& info, const std::vector<std::int64_t>& pts,
                const VideoSinkOptions& options) {
  const auto sink = make_file_sink(path, info, options);
  int number = 0;
  for (const std::int64_t at : pts) {
    OutputFrame frame = sink->allocate();
    fill(frame, made_picture(info.format, number++));
    sink->write(std::move(frame), at);
  }
  sink->finish();
}

ReadClip read_clip(const std::string& path, const OpenOptions& options) {
  ReadClip clip;
  const auto source = open_source(path, options);
  clip.info = source->info();
  while (const auto frame = source->next()) {
    EXPECT_EQ(frame->index, static_cast<std::int64_t>(clip.pts.size()));
    EXPECT_EQ(frame->format, clip.info.format);
    clip.pts.push_back(frame->pts);
    clip.time_s.push_back(frame->time_s);
    clip.duration_s.push_back(frame->duration_s);
    clip.pictures.push_back(samples_of(*frame));
  }
  clip.damaged = source->damaged();
  return clip;
}

void copy_clip(const std::string& in, const fs::path& out, const VideoSinkOptions& options) {
  const auto source = open_source(in);
  const auto sink = make_file_sink(out, source->info(), options);
  while (auto frame = source->next()) sink->write_untouched(std::move(*frame));
  sink->finish();
}

int greatest_difference(const Samples& a, const Samples& b) {
  int greatest = 0;
  for (std::size_t plane = 0; plane < 3; ++plane) {
    EXPECT_EQ(a[plane].size(), b[plane].size());
    for (std::size_t i = 0; i < std::min(a[plane].size(), b[plane].size()); ++i) {
      greatest = std::max(greatest, std::abs(a[plane][i] - b[plane][i]));
    }
  }
  return greatest;
}

std::string run(const std::string& command) {
  std::string printed;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::array<char, 4096> part{};
  while (const std::size_t got = fread(part.data(), 1, part.size(), pipe)) printed.append(part.data(), got);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return printed;
}

}  // namespace ar::testing
