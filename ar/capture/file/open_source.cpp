#include "ar/capture/file/open_source.h"

#include "ar/capture/file/image_list.h"
#include "ar/capture/file/video_file.h"

namespace ar {

std::unique_ptr<FrameSource> open_source(const std::string& path_or_pattern, const OpenOptions& options) {
  namespace fs = std::filesystem;
  std::error_code error;
  const bool exists = fs::exists(path_or_pattern, error);
  const bool pattern = !exists && (is_printf_pattern(path_or_pattern) || is_glob_pattern(path_or_pattern));
  if (pattern || fs::is_directory(path_or_pattern, error)) {
    return std::make_unique<ImageList>(path_or_pattern, list_images(path_or_pattern), options);
  }
  return std::make_unique<VideoFile>(path_or_pattern, options);
}

}  // namespace ar
