#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace render {

using Bytes = std::vector<std::uint8_t>;

// All bytes of a file. Throws std::runtime_error that names the file and the system's reason.
Bytes read_file(const std::filesystem::path& path);

// What becomes of a file that is already under the final name.
enum class Existing { Replace, Keep };

// Renames a finished file to its final name, at once. Throws std::system_error that names the final name: errc
// file_exists where something is there that is to be kept, if it appeared a moment ago.
void rename_whole(const std::filesystem::path& from, const std::filesystem::path& to, Existing existing);

// Writes beside the final name, flushes to the disk, then renames: an earlier file stays intact until the new one is
// complete. Throws std::runtime_error that names the file and the system's reason; then nothing is left behind.
void write_file_whole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                      Existing existing = Existing::Replace);

}  // namespace render
