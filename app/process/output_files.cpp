#include "app/process/output_files.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <system_error>

#include "app/error.h"
#include "ar/capture/file/image_list.h"
#include "ar/error.h"
#include "render/base/whole_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

// The files that are meant: of a folder and of a pattern, those that are there, else the path itself.
std::vector<fs::path> files_of(const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_directory(path, error)) return {path};
  try {
    return ar::list_images(path.string());
  } catch (const ar::InputError&) {
    return {path};  // it will be one
  }
}

bool same_file(const fs::path& a, const fs::path& b) {
  struct stat of_a {};
  struct stat of_b {};
  const bool a_exists = ::stat(a.c_str(), &of_a) == 0;
  const bool b_exists = ::stat(b.c_str(), &of_b) == 0;
  if (a_exists != b_exists) return false;
  if (a_exists) return of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
  std::error_code error;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error), error);
  return whole_a == fs::weakly_canonical(fs::absolute(b, error), error);
}

void refuse_same(const NamedPath& output, const NamedPath& other) {
  if (output.path.empty() || other.path.empty()) return;
  const std::vector<fs::path> others = files_of(other.path);
  for (const fs::path& file : files_of(output.path)) {
    const bool same = std::any_of(others.begin(), others.end(), [&](const fs::path& o) { return same_file(file, o); });
    if (!same) continue;
    throw UsageError(fmt::format("{} and {} are the same file, {}\ngive {} another name", other.option, output.option,
                                 file.string(), output.option));
  }
}

}  // namespace

void check_files(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs, bool overwrite) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    for (const NamedPath& input : inputs) refuse_same(*output, input);
    for (auto earlier = outputs.begin(); earlier != output; ++earlier) refuse_same(*output, *earlier);
  }
  for (const NamedPath& output : outputs) {
    if (!output.path.empty()) check_may_write(output.path, overwrite);
  }
}

void check_may_write(const std::filesystem::path& path, bool overwrite) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw std::runtime_error(fmt::format("{}: is a folder\nname a file in it", path.string()));
  }
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
    throw std::runtime_error(fmt::format(
        "{}: is a device or pipe, whose place the finished file would take\nname a regular file", path.string()));
  }
  if (!overwrite && std::filesystem::exists(path, error)) {
    throw std::runtime_error(fmt::format("{}: exists already\ngive another name, or --overwrite", path.string()));
  }
  const auto folder = path.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
    throw std::runtime_error(fmt::format("{}: there is no folder {}\nmake it first", path.string(), folder.string()));
  }
}

void write_whole(const std::filesystem::path& path, const std::string& text, bool overwrite) {
  check_may_write(path, overwrite);
  render::write_file_whole(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                           overwrite ? render::Existing::Replace : render::Existing::Keep);
}

}  // namespace app
