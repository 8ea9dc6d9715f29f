#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

// The project's own sources, for tests that read them.
namespace sources {

namespace fs = std::filesystem;

inline fs::path root() {
  return SKYSHAFT_SOURCE_DIR;
}

inline std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline bool is_cpp(const fs::path& path) {
  return path.extension() == ".cpp" || path.extension() == ".h";
}

// Paths from the root, '/' between folders.
inline std::vector<std::string> sources_below(const std::vector<std::string>& folders, bool wanted(const fs::path&)) {
  std::vector<std::string> found;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(root() / folder)) {
      if (entry.is_regular_file() && wanted(entry.path())) found.push_back(fs::relative(entry.path(), root()).string());
    }
  }
  return found;
}

}  // namespace sources
