#include "render/gl/flat_uniforms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>

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

// A line "uniform vec3 name[9];  // rest", or one of a block without its "uniform".
struct Declaration {
  std::string type;
  std::string name;
  std::string bounds;  // "[9]" or nothing
  int count = 1;
  std::string rest;
  bool in_block = false;
};

std::optional<Declaration> declared_by(const std::string& line, bool in_block = false) {
  static const std::regex declaration(
      R"re(\s*(uniform\s+)?(?:(?:low|medium|high)p\s+)?(\w+)\s+(\w+)(?:\[(\d+)\])?\s*;(.*))re");
  std::smatch found;
  if (!in_block && line.find("uniform") == std::string::npos) return std::nullopt;
  if (!std::regex_match(line, found, declaration) || found[1].matched == in_block) return std::nullopt;
  const bool array = found[4].matched;
  return Declaration{.type = found[2],
                     .name = found[3],
                     .bounds = array ? fmt::format("[{}]", found[4].str()) : std::string(),
                     .count = array ? std::stoi(found[4]) : 1,
                     .rest = found[5],
                     .in_block = in_block};
}

// Whether a line begins a uniform block, and its name.
std::optional<std::string> block_begun_by(const std::string& line) {
  static const std::regex begin(R"re(\s*layout\s*\(\s*std140\s*\)\s*uniform\s+(\w+)\s*\{.*)re");
  std::smatch found;
  if (line.find("std140") == std::string::npos || !std::regex_match(line, found, begin)) return std::nullopt;
  return found[1].str();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Calls line(text, declaration or nothing, whether it is the frame of a block) for each.
template <typename F>
void for_each_line(const std::vector<std::string>& lines, const F& visit) {
  bool in_block = false;
  for (const std::string& line : lines) {
    const bool begins = block_begun_by(line).has_value();
    const bool ends = in_block && line.find('}') != std::string::npos;
    visit(line, declared_by(line, in_block), begins || ends);
    in_block = (in_block || begins) && !ends;
  }
}

std::map<std::string, Declaration> declarations_in(const std::vector<std::string>& lines) {
  std::map<std::string, Declaration> all;
  for_each_line(lines, [&](const std::string&, const std::optional<Declaration>& declaration, bool) {
    if (declaration) all.emplace(declaration->name, *declaration);
  });
  return all;
}

// The blocks' texts by their names.
std::map<std::string, std::string> blocks_in(const std::vector<std::string>& lines) {
  std::map<std::string, std::string> blocks;
  std::string* open = nullptr;
  for (const std::string& line : lines) {
    if (const auto name = block_begun_by(line)) open = &blocks[*name];
    if (open == nullptr) continue;
    *open += line + "\n";
    if (line.find('}') != std::string::npos) open = nullptr;
  }
  return blocks;
}

// The first varying of each uniform that is handed on.
std::map<std::string, int> places_of(std::vector<FragmentUniform> uniforms,
                                     const std::map<std::string, Declaration>& declarations, int vectors) {
  const auto in_block = [&](const FragmentUniform& uniform) {
    const auto declaration = declarations.find(uniform.name);
    return declaration != declarations.end() && declaration->second.in_block;
  };
  // Where not all fit: those first of which a vector holds most.
  std::stable_sort(uniforms.begin(), uniforms.end(), [&](const FragmentUniform& a, const FragmentUniform& b) {
    return std::pair(in_block(a), size_of(a.type).numbers) > std::pair(in_block(b), size_of(b.type).numbers);
  });
  std::map<std::string, int> places;
  int next = 0;
  for (const FragmentUniform& uniform : uniforms) {
    const auto declaration = declarations.find(uniform.name);
    if (declaration == declarations.end()) continue;
    const int size = size_of(uniform.type).vectors * declaration->second.count;
    if (size == 0 || next + size > vectors) {
      if (!declaration->second.in_block) continue;
      throw std::runtime_error(fmt::format("the block's {} does not fit into {} varyings", uniform.name, vectors));
    }
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
    if (exact.find('.') != std::string::npos) continue;  // of a struct
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
  for_each_line(fragment, [&](const std::string& line, const std::optional<Declaration>& old, bool frame_of_block) {
    const auto place = old ? places.find(old->name) : places.end();
    if (frame_of_block) {
      out.fragment += "\n";
    } else if (place == places.end() && old && old->in_block) {
      // Named somewhere, but nothing that is drawn comes of it.
      out.fragment += fmt::format("highp {} {}{};{}\n", old->type, old->name, old->bounds, old->rest);
    } else if (place == places.end()) {
      out.fragment += line + "\n";
    } else {
      out.fragment += fmt::format("layout(location = {}) flat in highp {} {}{};{}\n", place->second, old->type,
                                  old->name, old->bounds, old->rest);
    }
  });
  static const std::regex main_function(R"re(\bvoid\s+main\s*\(\s*\))re");
  out.vertex = std::regex_replace(texts.vertex, main_function, "void draw()");
  const std::map<std::string, std::string> vertex_blocks = blocks_in(lines_of(texts.vertex));
  for (const auto& [name, text] : blocks_in(fragment)) {
    if (!vertex_blocks.contains(name)) out.vertex += text;
  }
  std::string handing;
  for (const auto& [name, place] : places) {
    const Declaration& old = in_fragment.at(name);
    if (!in_vertex.contains(name) && !old.in_block) {
      out.vertex += fmt::format("uniform highp {} {}{};\n", old.type, name, old.bounds);
    }
    out.vertex +=
        fmt::format("layout(location = {}) flat out highp {} handed_{}{};\n", place, old.type, place, old.bounds);
    handing += fmt::format("  handed_{} = {};\n", place, name);
  }
  out.vertex += "void main() {\n  draw();\n" + handing + "}\n";
  return out;
}

std::string without_blocks(const std::string& text) {
  std::string out;
  for_each_line(lines_of(text), [&](const std::string& line, const std::optional<Declaration>& old, bool frame) {
    if (frame) {
      out += "\n";
    } else if (old && old->in_block) {
      out += fmt::format("uniform highp {} {}{};{}\n", old->type, old->name, old->bounds, old->rest);
    } else {
      out += line + "\n";
    }
  });
  return out;
}

}  // namespace render::gl
