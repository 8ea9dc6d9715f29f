#include "ar/capture/file/image_list.h"

#include <fmt/format.h>
#include <glob.h>
#include <spdlog/spdlog.h>

extern "C" {
#include <libavutil/rational.h>
}

#include <algorithm>
#include <cctype>
#include <regex>
#include <stdexcept>

#include "ar/capture/file/decoder.h"
#include "ar/capture/file/metadata.h"
#include "ar/error.h"

namespace ar {
namespace {

namespace fs = std::filesystem;

struct PrintfPattern {
  std::string before;
  int width = 0;  // at least so many digits, zeros in front
  std::string after;
};

std::string without_double_percent(const std::string& text) {
  static const std::regex twice("%%");
  return std::regex_replace(text, twice, "%");
}

std::optional<PrintfPattern> parse_printf(const std::string& text) {
  static const std::regex number(R"(^((?:[^%]|%%)*)%(?:0?(\d+))?d((?:[^%]|%%)*)$)");
  std::smatch match;
  if (!std::regex_match(text, match, number)) return std::nullopt;
  const std::string width = match[2];
  if (width.size() > 2) return std::nullopt;
  return PrintfPattern{without_double_percent(match[1]), width.empty() ? 0 : std::stoi(width),
                       without_double_percent(match[3])};
}

// "2" before "10": runs of digits compare as numbers.
bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    while (i + 1 < a.size() && a[i] == '0' && digit(a[i + 1])) ++i;
    while (j + 1 < b.size() && b[j] == '0' && digit(b[j + 1])) ++j;
    std::size_t a_end = i;
    std::size_t b_end = j;
    while (a_end < a.size() && digit(a[a_end])) ++a_end;
    while (b_end < b.size() && digit(b[b_end])) ++b_end;
    if (a_end - i != b_end - j) return a_end - i < b_end - j;
    if (const int order = a.compare(i, a_end - i, b, j, b_end - j); order != 0) return order < 0;
    i = a_end;
    j = b_end;
  }
  return a.size() - i < b.size() - j;
}

bool is_picture(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static const std::vector<std::string> known{".png", ".jpg", ".jpeg", ".jpe", ".tif", ".tiff", ".bmp", ".webp",
                                              ".ppm", ".pgm", ".pnm",  ".jp2", ".j2k", ".tga",  ".dpx", ".jxl"};
  return std::find(known.begin(), known.end(), extension) != known.end();
}

// Entries of the folder that `keep` names a number or a rank for; hidden ones never.
std::vector<fs::path> list_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file(error) && !entry.path().filename().string().starts_with('.')) files.push_back(entry);
  }
  return files;
}

std::vector<fs::path> match_printf(const std::string& text) {
  const fs::path path(text);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const auto pattern = parse_printf(path.filename().string());
  std::vector<std::pair<long long, fs::path>> numbered;
  for (const fs::path& file : list_folder(folder)) {
    const std::string name = file.filename().string();
    const std::size_t fixed = pattern->before.size() + pattern->after.size();
    if (name.size() <= fixed || !name.starts_with(pattern->before) || !name.ends_with(pattern->after)) continue;
    const std::string digits = name.substr(pattern->before.size(), name.size() - fixed);
    if (digits.size() > 18 || digits.find_first_not_of("0123456789") != std::string::npos) continue;
    const long long number = std::stoll(digits);
    if (fmt::format("{:0{}}", number, pattern->width) == digits) numbered.emplace_back(number, file);
  }
  std::sort(numbered.begin(), numbered.end());
  std::vector<fs::path> files;
  for (auto& [number, file] : numbered) files.push_back(std::move(file));
  return files;
}

std::vector<fs::path> match_glob(const std::string& pattern) {
  glob_t found{};
  std::vector<fs::path> files;
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0) {
    for (std::size_t i = 0; i < found.gl_pathc; ++i) files.emplace_back(found.gl_pathv[i]);
  }
  globfree(&found);
  return files;
}

ffmpeg::FramePtr decode_picture(const fs::path& file) {
  // One thread: there is one frame, and starting threads costs more than it saves.
  Decoder decoder(file, file.string(), 1);
  ffmpeg::FramePtr picture = decoder.next();
  if (!picture) throw InputError(fmt::format("cannot read {}: damaged picture\nCopy it again.", file.string()));
  return picture;
}

}  // namespace

bool is_printf_pattern(const std::string& text) {
  return parse_printf(fs::path(text).filename().string()).has_value();
}

bool is_glob_pattern(const std::string& text) {
  return text.find_first_of("*?[") != std::string::npos;
}

std::string printf_name(const std::string& pattern, std::int64_t number) {
  const auto parsed = parse_printf(fs::path(pattern).filename().string());
  if (!parsed) {
    throw std::invalid_argument(fmt::format("'{}' has no single number like %04d in its file name", pattern));
  }
  const std::string name = fmt::format("{}{:0{}}{}", parsed->before, number, parsed->width, parsed->after);
  return (fs::path(pattern).parent_path() / name).string();
}

std::vector<fs::path> list_images(const std::string& pattern_or_folder) {
  std::vector<fs::path> files;
  std::error_code error;
  if (fs::is_directory(pattern_or_folder, error)) {
    files = list_folder(pattern_or_folder);
    std::erase_if(files, [](const fs::path& file) { return !is_picture(file); });
  } else if (is_printf_pattern(pattern_or_folder)) {
    files = match_printf(pattern_or_folder);
    if (!files.empty()) return files;
  } else {
    files = match_glob(pattern_or_folder);
  }
  if (files.empty()) {
    throw InputError(
        fmt::format("cannot read {}: no pictures there\nGive a folder of pictures, or a pattern such as "
                    "shot_%04d.png or 'shots/*.jpg'.",
                    pattern_or_folder));
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return natural_less(a.string(), b.string()); });
  return files;
}

ImageList::ImageList(std::string name, std::vector<fs::path> files, const OpenOptions& options)
    : files_(std::move(files)), options_(options), pending_(decode_picture(files_.front())) {
  maker_ = std::make_unique<FrameMaker>(*pending_, nullptr, name, options_);
  maker_->describe(info_);
  const AVRational rate = av_d2q(options_.image_frame_rate, 1001000);
  if (rate.num <= 0 || rate.den <= 0) {
    throw std::invalid_argument(fmt::format("image frame rate must be positive, found {}", options_.image_frame_rate));
  }
  info_.name = std::move(name);
  info_.time_base = {rate.den, rate.num};
  info_.frame_rate = {rate.num, rate.den};
  info_.frame_count = static_cast<std::int64_t>(files_.size());
  info_.duration_s = static_cast<double>(files_.size()) / av_q2d(rate);
  info_.recorded = recorded_at(pending_->metadata);
  info_.codec = "pictures";
}

std::optional<Frame> ImageList::next() {
  for (; at_ < files_.size(); ++at_) {
    try {
      Frame frame = maker_->make(pending_ ? std::move(pending_) : decode_picture(files_[at_]), true);
      const double step_s = static_cast<double>(info_.time_base.num) / info_.time_base.den;
      frame.index = frames_++;
      frame.pts = static_cast<std::int64_t>(at_++);
      frame.time_s = static_cast<double>(frame.pts) * step_s;
      frame.duration_s = step_s;
      return frame;
    } catch (const InputError& error) {
      ++damaged_;
      const std::string what = error.what();
      spdlog::warn("{}: passed over: {}", files_[at_].string(), what.substr(0, what.find('\n')));
    }
  }
  return std::nullopt;
}

}  // namespace ar
