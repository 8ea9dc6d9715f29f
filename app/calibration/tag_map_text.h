#pragma once

#include <functional>
#include <string>

#include "ar/track/tag_map.h"

namespace app {

// A tag map as a scene's `tags: { file: ... }` reads it. `note_of` gives each tag's comment.
std::string tag_map_text(const ar::TagMap& map, const std::string& heading,
                         const std::function<std::string(int)>& note_of);

}  // namespace app
