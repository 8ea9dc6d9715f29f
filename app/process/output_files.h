#pragma once

#include <filesystem>

namespace app {

// Throws std::runtime_error when something is at `path` and may not be overwritten, or the folder does not exist.
void check_may_write(const std::filesystem::path& path, bool overwrite);

}  // namespace app
