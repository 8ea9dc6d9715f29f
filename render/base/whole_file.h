#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace render {

using Bytes = std::vector<std::uint8_t>;

// All bytes of a file. Throws std::runtime_error that names the file and the system's reason.
Bytes read_file(const std::filesystem::path& path);

// Writes beside the final name, flushes to the disk, then renames: an earlier file stays intact until the new one is
// complete. Throws std::runtime_error that names the file and the system's reason; then nothing is left behind.
void write_file_whole(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace render
