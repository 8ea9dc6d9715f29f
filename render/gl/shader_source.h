#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace render::gl {

// A preprocessor symbol that specialises a shader: `#define name value`.
struct Define {
  std::string name;
  std::string value = "1";
};
using Defines = std::vector<Define>;

// Text of the file `path` below shaders/ ("composite/merge.frag"), as embedded at build time.
std::optional<std::string_view> embedded_shader(std::string_view path);

// A shader with its `#include "lib/color.glsl"` lines replaced by the files (each once; paths count from shaders/),
// and the defines put behind `#version`. `#line` keeps the numbers; files[n] is the file of GLSL source string n.
struct ShaderSource {
  std::string text;
  std::vector<std::string> files;
};

// Throws std::logic_error that names a file which is not embedded and who includes it.
ShaderSource expand_shader(std::string_view path, const Defines& defines);

// A driver's compile log with its source numbers replaced: "shaders/lib/color.glsl:12: error ...". Knows the forms
// of Mesa "1:12(3): ", NVIDIA "1(12) : " and of the others "ERROR: 1:12: ".
std::string readable_log(const std::string& log, const std::vector<std::string>& files);

}  // namespace render::gl
