#pragma once

#include <filesystem>
#include <string>

namespace app {

// Throws std::runtime_error when something is at `path` and may not be overwritten, or the folder does not exist.
void check_may_write(const std::filesystem::path& path, bool overwrite);

// Checks as above, then writes the text so that the file appears whole: beside the final name, renamed when complete.
void write_whole(const std::filesystem::path& path, const std::string& text, bool overwrite);

}  // namespace app
