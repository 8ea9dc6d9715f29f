#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace app {

// A file, pattern of pictures or folder that a command reads or writes, and the option that names it.
struct NamedPath {
  std::string option;          // "--poses", or the name of an argument, "IN"
  std::filesystem::path path;  // empty: the option was not given
};

// Before a command starts: throws UsageError, which names both options, where an output is also an input or another
// output, whatever its name (links, patterns and folders of pictures are looked through), and as check_may_write()
// does.
void check_files(const std::vector<NamedPath>& inputs, const std::vector<NamedPath>& outputs, bool overwrite);

// Throws std::runtime_error when something is at `path` and may not be overwritten, it is no regular file (a device, a
// pipe: the finished file would take its place), or the folder does not exist.
void check_may_write(const std::filesystem::path& path, bool overwrite);

// Checks as above, then writes the text so that the file appears whole: beside the final name, renamed when complete,
// not over what appeared meanwhile unless `overwrite`.
void write_whole(const std::filesystem::path& path, const std::string& text, bool overwrite);

}  // namespace app
