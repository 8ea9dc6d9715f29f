#pragma once

#include <memory>
#include <string>

#include "ar/capture/source.h"

namespace ar {

struct OpenOptions {
  bool tone_map_hdr = false;       // otherwise PQ and HLG are refused with InputError
  double image_frame_rate = 25.0;  // of an image sequence
  int threads = 0;                 // decoder threads, 0: as many as the machine has
};

// Opens a video file, one picture, a printf or glob pattern of pictures ("shot_%04d.png", "shots/*.jpg") or a folder of
// pictures (of one size). Throws InputError that names the file and what is wrong (missing, empty, no video stream,
// unknown codec).
std::unique_ptr<FrameSource> open_source(const std::string& path_or_pattern, const OpenOptions& options = {});

}  // namespace ar
