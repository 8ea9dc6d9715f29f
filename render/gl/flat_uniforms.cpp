#include "render/gl/flat_uniforms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

namespace render::gl {
namespace {

// Varyings of four numbers that one of a type takes, and how many numbers each of them holds then.
struct Size {
  int vectors = 0;  // 0: it cannot be handed on
  int numbers = 0;
};

Size size_of(GLenum type) {
  switch (type) {
    case GL_FLOAT:
    case GL_INT:
      return {1, 1};
    case GL_FLOAT_VEC2:
    case GL_INT_VEC2:
      return {1, 2};
    case GL_FLOAT_VEC3:
    case GL_INT_VEC3:
      return {1, 3};
    case GL_FLOAT_VEC4:
    case GL_INT_VEC4:
      return {1, 4};
    case GL_FLOAT_MAT3:
      return {3, 3};
    case GL_FLOAT_MAT4:
      return {4, 4};
    default:
      return {};
  }
}

// A line "uniform vec3 name[9];  // rest".
struct Declaration {
  std::string type;
  std::string name;
  std::string bounds;  // "[9]" or nothing
  int count = 1;
  std::string rest;
};

std::optional<Declaration> declared_by(const std::string& line) {
  static const std::regex declaration(
      R"re(\s*uniform\s+(?:(?:low|medium|high)p\s+)?(\w+)\s+(\w+)(?:\[(\d+)\])?\s*;(.*))re");
  std::smatch found;
  if (line.find("uniform") == std::string::npos || !std::regex_match(line, found, declaration)) return std::nullopt;
  const bool array = found[3].matched;
  return Declaration{found[1], found[2], array ? fmt::format("[{}]", found[3].str()) : std::string(),
                     array ? std::stoi(found[3]) : 1, found[4]};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::map<std::string, Declaration> declarations_in(const std::vector<std::string>& lines) {
  std::map<std::string, Declaration> all;
  for (const std::string& line : lines) {
    if (const auto declaration = declared_by(line)) all.emplace(declaration->name, *declaration);
  }
  return all;
}

// The first varying of each uniform that is handed on.
std::map<std::string, int> places_of(std::vector<FragmentUniform> uniforms,
                                     const std::map<std::string, Declaration>& declarations, int vectors) {
  // Where not all fit: those first of which a vector holds most.
  std::stable_sort(uniforms.begin(), uniforms.end(), [](const FragmentUniform& a, const FragmentUniform& b) {
    return size_of(a.type).numbers > size_of(b.type).numbers;
  });
  std::map<std::string, int> places;
  int next = 0;
  for (const FragmentUniform& uniform : uniforms) {
    const auto declaration = declarations.find(uniform.name);
    if (declaration == declarations.end()) continue;
    const int size = size_of(uniform.type).vectors * declaration->second.count;
    if (size == 0 || next + size > vectors) continue;
    places.emplace(uniform.name, next);
    next += size;
  }
  return places;
}

}  // namespace

std::vector<FragmentUniform> fragment_uniforms(GLuint program) {
  GLint count = 0;
  GLint longest = 0;
  glGetProgramInterfaceiv(program, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
  glGetProgramInterfaceiv(program, GL_UNIFORM, GL_MAX_NAME_LENGTH, &longest);
  std::vector<FragmentUniform> uniforms;
  std::string name(static_cast<std::size_t>(longest) + 1, '\0');
  constexpr std::array<GLenum, 2> kProperties{GL_REFERENCED_BY_FRAGMENT_SHADER, GL_TYPE};
  for (GLint i = 0; i < count; ++i) {
    const auto index = static_cast<GLuint>(i);
    std::array<GLint, 2> found{};
    glGetProgramResourceiv(program, GL_UNIFORM, index, 2, kProperties.data(), 2, nullptr, found.data());
    if (found[0] == GL_FALSE) continue;
    GLsizei length = 0;
    glGetProgramResourceName(program, GL_UNIFORM, index, longest + 1, &length, name.data());
    const std::string exact = name.substr(0, static_cast<std::size_t>(length));
    uniforms.push_back({exact.substr(0, exact.find('[')), static_cast<GLenum>(found[1])});
  }
  return uniforms;
}

bool draws_large_primitives(const std::string& vertex_text) {
  return vertex_text.find("#pragma skyshaft large_primitives") != std::string::npos;
}

StageTexts hand_on_uniforms(const StageTexts& texts, const std::vector<FragmentUniform>& uniforms, int vectors) {
  const std::vector<std::string> fragment = lines_of(texts.fragment);
  const std::map<std::string, Declaration> in_vertex = declarations_in(lines_of(texts.vertex));
  const std::map<std::string, Declaration> in_fragment = declarations_in(fragment);
  const std::map<std::string, int> places = places_of(uniforms, in_fragment, vectors);
  StageTexts out;
  for (const std::string& line : fragment) {
    const std::optional<Declaration> old = declared_by(line);
    const auto place = old ? places.find(old->name) : places.end();
    out.fragment += place == places.end() ? line + "\n"
                                          : fmt::format("layout(location = {}) flat in highp {} {}{};{}\n",
                                                        place->second, old->type, old->name, old->bounds, old->rest);
  }
  static const std::regex main_function(R"re(\bvoid\s+main\s*\(\s*\))re");
  out.vertex = std::regex_replace(texts.vertex, main_function, "void draw()");
  std::string handing;
  for (const auto& [name, place] : places) {
    const Declaration& old = in_fragment.at(name);
    if (!in_vertex.contains(name)) out.vertex += fmt::format("uniform highp {} {}{};\n", old.type, name, old.bounds);
    out.vertex +=
        fmt::format("layout(location = {}) flat out highp {} handed_{}{};\n", place, old.type, place, old.bounds);
    handing += fmt::format("  handed_{} = {};\n", place, name);
  }
  out.vertex += "void main() {\n  draw();\n" + handing + "}\n";
  return out;
}

}  // namespace render::gl
