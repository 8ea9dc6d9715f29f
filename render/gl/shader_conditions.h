#pragma once

#include <set>
#include <string>

namespace render::gl {

// What the preprocessor leaves of a shader's text: the lines of branches that are not taken are empty, so that lines
// keep their numbers. Knows #define, #undef, #if with defined(), macros, whole numbers, + - ! && || and comparisons,
// #ifdef, #ifndef, #elif, #else and #endif. Throws std::invalid_argument where a condition cannot be read.
std::string active_lines(const std::string& text);

// The uniforms that a shader declares, each on a line of its own ("uniform vec3 name[9];"), samplers and the members of
// uniform blocks ("layout(std140) uniform Block {" to "};") too. Of active_lines().
std::set<std::string, std::less<>> declared_uniforms(const std::string& text);

}  // namespace render::gl
