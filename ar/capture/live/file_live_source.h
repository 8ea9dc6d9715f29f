#pragma once

#include <filesystem>
#include <memory>

#include "ar/capture/live/live_source.h"

namespace ar {

// A video file (or pictures) played once as if a camera gave it: a frame is there from its own time on, counted from
// the first read(), and is stamped with that instant of CLOCK_MONOTONIC, however late it is asked for. `index`, `pts`
// and `duration_s` are the file's. Up to four frames wait for a reader, as in a driver's queue; beyond that the oldest
// are lost and counted as missed. Throws InputError as open_source()
// does, and read() where the file cannot be read on.
std::unique_ptr<LiveSource> open_file_live_source(const std::filesystem::path& clip);

}  // namespace ar
