#include "ar/output/sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "ar/capture/file/image_list.h"
#include "ar/error.h"
#include "ar/output/image_sink.h"
#include "ar/output/video_sink.h"

namespace ar {
namespace {

namespace fs = std::filesystem;

bool is_png(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png";
}

// The file, or a picture of the pattern, that is already there.
std::optional<fs::path> existing(const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error)) return path;
  if (!is_printf_pattern(path.string())) return std::nullopt;
  try {
    return list_images(path.string()).front();
  } catch (const InputError&) {
    return std::nullopt;  // none matches
  }
}

}  // namespace

std::unique_ptr<FrameSink> make_file_sink(const fs::path& path, const SourceInfo& source,
                                          const VideoSinkOptions& options) {
  const auto there = existing(path);
  if (there && !options.overwrite) {
    throw std::runtime_error(
        fmt::format("cannot write {}: {} exists\nGive another name, or --overwrite.", path.string(), there->string()));
  }
  if (there && fs::is_directory(*there)) {
    throw std::runtime_error(fmt::format("cannot write {}: it is a folder\nGive a file name.", path.string()));
  }
  if (is_png(path)) return std::make_unique<ImageSink>(path, source, options);
  return std::make_unique<VideoSink>(path, source, options);
}

}  // namespace ar
