#pragma once

#include <cstdint>

namespace render {

inline constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;  // of a picture that is read
inline constexpr std::int64_t kMaxSide = std::int64_t{1} << 16;    // pixels of its width and of its height

// Whether a picture that a file claims is within the limits and can be in it at all: sides from 1 to kMaxSide, no more
// than kMaxPixels, and no more than `pixels_per_byte` (what its best compression reaches) for each of `file_bytes`.
// Throws std::runtime_error that names the size, the limit passed, and `what` ("its data window").
void check_claimed_size(const char* what, std::int64_t width, std::int64_t height, std::uint64_t file_bytes,
                        std::uint64_t pixels_per_byte);

}  // namespace render
