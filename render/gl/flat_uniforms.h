#pragma once

#include <GLES3/gl31.h>

#include <string>
#include <vector>

namespace render::gl {

// Software rasterisers check the bounds of each number of a uniform anew for every few pixels: on Mesa's llvmpipe forty
// of them take 15 ms of a million pixels, and as many that a vertex shader hands on flat take 1. Not so on GPUs; and
// not where triangles are small, since each costs the setting up of all that is handed on.

// A uniform that a linked program's fragment shader reads; not those of structs.
struct FragmentUniform {
  std::string name;  // without "[0]"
  GLenum type = 0;   // of an array: its elements'
};
std::vector<FragmentUniform> fragment_uniforms(GLuint program);

// Whether a vertex shader draws few and large primitives: it says so by a line "#pragma skyshaft large_primitives".
bool draws_large_primitives(const std::string& vertex_text);

// The texts of a program's two shaders, GLSL ES 3.10, includes expanded.
struct StageTexts {
  std::string vertex;
  std::string fragment;
};

// The same text with the members of its uniform blocks ("layout(std140) uniform Name {" to "};", each member on a line
// of its own) as plain uniforms: of these, a linked program tells which it reads.
std::string without_blocks(const std::string& text);

// The same program, but that the vertex shader hands on `uniforms` to the fragment shader, flat: scalars, vectors and
// matrices of floats and ints and arrays of them, as far as `vectors` varyings of four numbers hold them, the fullest
// first; samplers and the rest stay as they are. They keep their names, and are uniforms of the vertex shader alone
// then. The fragment shader declares each on a line of its own, "uniform vec3 name;" or "uniform vec3 name[9];".
// Members of blocks come first: throws std::runtime_error where not all of them fit.
StageTexts hand_on_uniforms(const StageTexts& texts, const std::vector<FragmentUniform>& uniforms, int vectors);

}  // namespace render::gl
