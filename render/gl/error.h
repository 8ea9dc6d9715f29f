#pragma once

#include <string_view>

namespace render::gl {

// Throws std::runtime_error that names every pending GL error and `where`, if there is one.
void check_errors(std::string_view where);

}  // namespace render::gl
