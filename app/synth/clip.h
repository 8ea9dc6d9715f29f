#pragma once

#include <filesystem>
#include <functional>

#include "app/synth/spec.h"

namespace app::synth {

struct ClipOptions {
  bool overwrite = false;
  int crf = 16;
  std::function<void(int done, int total)> progress;  // may be empty
  std::function<bool()> stop;                         // asked before each frame; true ends the clip early
};

// Renders the spec's clip and writes it with the truth beside it (app/synth/truth.h). Returns the frames written.
// Throws std::runtime_error: a file is there already, or cannot be written.
int write_clip(const Spec& spec, const std::filesystem::path& clip, const ClipOptions& options);

}  // namespace app::synth
