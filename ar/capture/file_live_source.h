#pragma once

#include <filesystem>
#include <memory>

#include "ar/capture/live_source.h"

namespace ar {

// A video file (or pictures) played once as if a camera gave it: each frame becomes available at its own time after the
// first read(), stamped with that instant of CLOCK_MONOTONIC. Frames that fell behind because nobody read them stay in
// line, as they do in a driver's queue of four; beyond that the oldest are lost and counted as missed. `pts` and `index`
// are the file's. Throws InputError as open_source() does.
std::unique_ptr<LiveSource> open_file_live_source(const std::filesystem::path& clip);

}  // namespace ar
