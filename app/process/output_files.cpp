#include "app/process/output_files.h"

#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <system_error>

#include "render/base/whole_file.h"

namespace app {

void check_may_write(const std::filesystem::path& path, bool overwrite) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw std::runtime_error(fmt::format("{}: is a folder\nname a file in it", path.string()));
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
  render::write_file_whole(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace app
