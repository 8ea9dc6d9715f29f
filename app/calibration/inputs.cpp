#include "app/calibration/inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <set>

#include "ar/capture/file/open_source.h"
#include "ar/error.h"

namespace app {
namespace {

constexpr double kLookEvery = 0.1;     // s of a recording
constexpr double kMostFrames = 400.0;  // looked at in one

const std::set<std::string> kPictures{".bmp", ".jpeg", ".jpg", ".pgm", ".png", ".ppm", ".tif", ".tiff", ".webp"};

}  // namespace

bool is_picture(const std::string& input) {
  std::string kind = std::filesystem::path(input).extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kPictures.contains(kind);
}

std::vector<std::string> one_by_one(const std::vector<std::string>& inputs) {
  std::vector<std::string> files;
  for (const std::string& input : inputs) {
    std::error_code error;
    if (!std::filesystem::is_directory(input, error)) {
      files.push_back(input);
      continue;
    }
    std::vector<std::string> inside;
    for (const auto& entry : std::filesystem::directory_iterator(input)) {
      if (is_picture(entry.path().string())) inside.push_back(entry.path().string());
    }
    if (inside.empty()) {
      throw ar::InputError(
          fmt::format("{}: no pictures in this folder\naccepted: {}", input, fmt::join(kPictures, ", ")));
    }
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

std::unique_ptr<ar::FrameSource> open_quietly(const std::string& input) {
  const auto level = spdlog::get_level();
  spdlog::set_level(std::max(level, spdlog::level::warn));
  try {
    auto source = ar::open_source(input);
    spdlog::set_level(level);
    return source;
  } catch (...) {
    spdlog::set_level(level);
    throw;
  }
}

int frames_to_skip(const ar::SourceInfo& info) {
  const double rate = info.frame_rate.num > 0 ? static_cast<double>(info.frame_rate.num) / info.frame_rate.den : 30.0;
  const double count = info.frame_count ? static_cast<double>(*info.frame_count) : 0.0;
  return std::max(1, static_cast<int>(std::ceil(std::max(rate * kLookEvery - 0.5, count / kMostFrames))));
}

}  // namespace app
