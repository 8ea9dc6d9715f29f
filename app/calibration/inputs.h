#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ar/capture/source.h"

namespace app {

// The pictures of folders one by one, so that each is known by its own name; all else as it is. Throws ar::InputError
// for a folder without pictures.
std::vector<std::string> one_by_one(const std::vector<std::string>& inputs);

// By the name's ending.
bool is_picture(const std::string& input);

// Opens an input to measure brightness in it: what its colours mean does not matter and is not told.
std::unique_ptr<ar::FrameSource> open_quietly(const std::string& input);

// Of a recording, every so manyeth frame is looked at: ten a second, 400 in all.
int frames_to_skip(const ar::SourceInfo& recording);

}  // namespace app
