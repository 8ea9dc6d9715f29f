#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ar/capture/file/frame_maker.h"
#include "ar/capture/file/open_source.h"

namespace ar {

// Whether a name is a pattern: a printf number ("shot_%04d.png"), or a glob ("shots/*.jpg", with *, ? or [...]) that is
// not itself the name of a file.
bool is_printf_pattern(const std::string& text);
bool is_glob_pattern(const std::string& text);

// The name that a printf pattern gives to a number: ("shot_%04d.png", 7) is "shot_0007.png". "%%" is a percent sign.
// Throws std::invalid_argument unless there is exactly one %d, %Nd or %0Nd.
std::string printf_name(const std::string& pattern, std::int64_t number);

// The files that a pattern or a folder means, numbers in order of number, others in natural order ("2" before "10").
// Of a folder, the pictures (by extension). Throws InputError when there are none.
std::vector<std::filesystem::path> list_images(const std::string& pattern_or_folder);

// Pictures as a stream, at a constant rate; the size and format of the first. A picture that cannot be read, or is of
// another size, is counted, logged and passed over (its time stays empty).
class ImageList : public FrameSource {
 public:
  ImageList(std::string name, std::vector<std::filesystem::path> files, const OpenOptions& options);

  const SourceInfo& info() const override { return info_; }
  std::optional<Frame> next() override;
  std::int64_t damaged() const override { return damaged_; }

 private:
  std::vector<std::filesystem::path> files_;
  OpenOptions options_;
  std::unique_ptr<FrameMaker> maker_;
  ffmpeg::FramePtr pending_;
  SourceInfo info_;
  std::size_t at_ = 0;
  std::int64_t frames_ = 0;
  std::int64_t damaged_ = 0;
};

}  // namespace ar
