#include "render/gl/program.h"

#include <fmt/format.h>

#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "render/gl/error.h"
#include "render/gl/extensions.h"
#include "render/gl/flat_uniforms.h"
#include "render/gl/label.h"

namespace render::gl {
namespace {

std::string describe(const Defines& defines) {
  std::string out;
  for (const Define& define : defines) out += fmt::format(" {}={}", define.name, define.value);
  return out;
}

// Owns a shader object until the program is linked.
struct Shader {
  GLuint id;
  Shader(GLenum stage, std::string_view path, const Defines& defines, const ShaderSource& source)
      : id(glCreateShader(stage)) {
    const char* text = source.text.c_str();
    glShaderSource(id, 1, &text, nullptr);
    glCompileShader(id);
    GLint compiled = GL_FALSE;
    glGetShaderiv(id, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) return;
    GLint size = 0;
    glGetShaderiv(id, GL_INFO_LOG_LENGTH, &size);
    std::string log(static_cast<std::size_t>(std::max(size, 1)), '\0');
    GLsizei written = 0;
    glGetShaderInfoLog(id, static_cast<GLsizei>(log.size()), &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    glDeleteShader(id);
    throw std::runtime_error(fmt::format("shaders/{} with{} does not compile:\n{}", path, describe(defines),
                                         readable_log(log, source.files)));
  }
  ~Shader() { glDeleteShader(id); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
};

}  // namespace

Program::Program(std::string_view vertex_path, std::string_view fragment_path, const Defines& defines)
    : name_(fmt::format("{} + {}{}", vertex_path, fragment_path, describe(defines))) {
  ShaderSource vertex = expand_shader(vertex_path, defines);
  ShaderSource fragment = expand_shader(fragment_path, defines);
  const auto build = [&] {
    const Shader first(GL_VERTEX_SHADER, vertex_path, defines, vertex);
    const Shader second(GL_FRAGMENT_SHADER, fragment_path, defines, fragment);
    id_ = glCreateProgram();
    glAttachShader(id_, first.id);
    glAttachShader(id_, second.id);
    link();
  };
  build();
  if (!extensions().software || !draws_large_primitives(vertex.text)) return;
  constexpr int kOwnVaryings = 2;  // at most, of the shaders themselves
  GLint varyings = 0;
  glGetIntegerv(GL_MAX_VARYING_VECTORS, &varyings);
  StageTexts texts = hand_on_uniforms({std::move(vertex.text), std::move(fragment.text)}, fragment_uniforms(id_),
                                      varyings - kOwnVaryings);
  vertex.text = std::move(texts.vertex);
  fragment.text = std::move(texts.fragment);
  glDeleteProgram(std::exchange(id_, 0));
  build();
}

Program::Program(std::string_view compute_path, const Defines& defines)
    : name_(fmt::format("{}{}", compute_path, describe(defines))) {
  const Shader compute(GL_COMPUTE_SHADER, compute_path, defines, expand_shader(compute_path, defines));
  id_ = glCreateProgram();
  glAttachShader(id_, compute.id);
  link();
}

Program::Program(Program&& other) noexcept
    : id_(std::exchange(other.id_, 0)), name_(std::move(other.name_)), locations_(std::move(other.locations_)) {}

Program& Program::operator=(Program&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(name_, other.name_);
  std::swap(locations_, other.locations_);
  return *this;
}

Program::~Program() {
  glDeleteProgram(id_);
}

void Program::link() {
  glLinkProgram(id_);
  GLint linked = GL_FALSE;
  glGetProgramiv(id_, GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    GLint size = 0;
    glGetProgramiv(id_, GL_INFO_LOG_LENGTH, &size);
    std::string log(static_cast<std::size_t>(std::max(size, 1)), '\0');
    glGetProgramInfoLog(id_, size, nullptr, log.data());
    glDeleteProgram(std::exchange(id_, 0));
    throw std::runtime_error(fmt::format("{} does not link:\n{}", name_, log.c_str()));
  }
  label(LabelKind::Program, id_, name_);
  list_uniforms();
}

void Program::list_uniforms() {
  locations_.clear();
  GLint count = 0;
  GLint longest = 0;
  glGetProgramiv(id_, GL_ACTIVE_UNIFORMS, &count);
  glGetProgramiv(id_, GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
  std::string name(static_cast<std::size_t>(longest) + 1, '\0');
  for (GLint i = 0; i < count; ++i) {
    GLsizei length = 0;
    GLint size = 0;
    GLenum type = 0;
    glGetActiveUniform(id_, static_cast<GLuint>(i), longest + 1, &length, &size, &type, name.data());
    const std::string exact = name.substr(0, static_cast<std::size_t>(length));
    const GLint place = glGetUniformLocation(id_, exact.c_str());
    locations_[exact] = place;
    if (exact.ends_with("[0]")) locations_[exact.substr(0, exact.size() - 3)] = place;
  }
}

void Program::use() const {
  glUseProgram(id_);
}

GLint Program::location(std::string_view uniform) const {
  const auto found = locations_.find(uniform);
  return found == locations_.end() ? -1 : found->second;
}

void Program::set(std::string_view uniform, int value) const {
  glProgramUniform1i(id_, location(uniform), value);
}
void Program::set(std::string_view uniform, float value) const {
  glProgramUniform1f(id_, location(uniform), value);
}
void Program::set(std::string_view uniform, const glm::vec2& value) const {
  glProgramUniform2fv(id_, location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::vec3& value) const {
  glProgramUniform3fv(id_, location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::vec4& value) const {
  glProgramUniform4fv(id_, location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::ivec2& value) const {
  glProgramUniform2iv(id_, location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::ivec4& value) const {
  glProgramUniform4iv(id_, location(uniform), 1, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::mat3& value) const {
  glProgramUniformMatrix3fv(id_, location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::mat4& value) const {
  glProgramUniformMatrix4fv(id_, location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(std::string_view uniform, const glm::vec3* values, int count) const {
  glProgramUniform3fv(id_, location(uniform), count, glm::value_ptr(*values));
}
void Program::set(std::string_view uniform, const glm::vec4* values, int count) const {
  glProgramUniform4fv(id_, location(uniform), count, glm::value_ptr(*values));
}

}  // namespace render::gl
