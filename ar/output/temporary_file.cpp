#include "ar/output/temporary_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <system_error>

#include "render/base/whole_file.h"

namespace ar {
namespace {

namespace fs = std::filesystem;

fs::path hidden_beside(const fs::path& final_path) {
  static std::atomic<int> count{0};
  const std::string name = fmt::format(".{}.{}-{}.part", final_path.filename().string(), ::getpid(), count++);
  return final_path.parent_path() / name;
}

}  // namespace

TemporaryPath::TemporaryPath(fs::path final_path, bool overwrite, bool in_place)
    : final_(std::move(final_path)),
      temporary_(in_place ? final_ : hidden_beside(final_)),
      overwrite_(overwrite),
      committed_(in_place) {
  const fs::path folder = final_.has_parent_path() ? final_.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error(fmt::format("cannot write {}: there is no folder {}\nMake the folder first.",
                                         final_.string(), folder.string()));
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw std::runtime_error(fmt::format("cannot write {}: the folder {} is not writable\nWrite to another folder.",
                                         final_.string(), folder.string()));
  }
}

TemporaryPath::~TemporaryPath() {
  if (committed_) return;
  std::error_code ignored;  // nothing to do about it in a destructor
  fs::remove_all(temporary_, ignored);
}

void TemporaryPath::commit() {
  if (temporary_ == final_) return;
  try {
    render::rename_whole(temporary_, final_, overwrite_ ? render::Existing::Replace : render::Existing::Keep);
  } catch (const std::system_error& error) {
    if (error.code() != std::errc::file_exists) {
      throw std::runtime_error(
          fmt::format("cannot rename {} to {}: {}", temporary_.string(), final_.string(), error.code().message()));
    }
    committed_ = true;  // what took long to make is not thrown away
    throw std::runtime_error(fmt::format("cannot write {}: it appeared meanwhile\nThe finished file is {}: rename it.",
                                         final_.string(), temporary_.string()));
  }
  committed_ = true;
}

}  // namespace ar
