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
#include "render/gl/shader_conditions.h"

namespace render::gl {
namespace {

std::string describe(const Defines& defines) {
  std::string out;
  for (const Define& define : defines) out += fmt::format(" {}={}", define.name, define.value);
  return out;
}

bool is_sampler(GLenum type) {
  switch (type) {
    case GL_SAMPLER_2D:
    case GL_SAMPLER_3D:
    case GL_SAMPLER_CUBE:
    case GL_SAMPLER_2D_SHADOW:
    case GL_SAMPLER_2D_ARRAY:
    case GL_SAMPLER_2D_ARRAY_SHADOW:
    case GL_SAMPLER_CUBE_SHADOW:
    case GL_INT_SAMPLER_2D:
    case GL_INT_SAMPLER_3D:
    case GL_INT_SAMPLER_2D_ARRAY:
    case GL_UNSIGNED_INT_SAMPLER_2D:
    case GL_UNSIGNED_INT_SAMPLER_3D:
    case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
      return true;
    default:
      return false;
  }
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
  const ShaderSource vertex = expand_shader(vertex_path, defines);
  const ShaderSource fragment = expand_shader(fragment_path, defines);
  declared_ = declared_uniforms(vertex.text);
  declared_.merge(declared_uniforms(fragment.text));
  const auto build = [&](std::string vertex_text, std::string fragment_text) {
    const Shader first(GL_VERTEX_SHADER, vertex_path, defines, {std::move(vertex_text), vertex.files});
    const Shader second(GL_FRAGMENT_SHADER, fragment_path, defines, {std::move(fragment_text), fragment.files});
    id_ = glCreateProgram();
    glAttachShader(id_, first.id);
    glAttachShader(id_, second.id);
    link();
  };
  if (!extensions().software || !draws_large_primitives(vertex.text)) {
    build(vertex.text, fragment.text);
    return;
  }
  build(without_blocks(vertex.text), without_blocks(fragment.text));
  constexpr int kOwnVaryings = 2;  // at most, of the shaders themselves
  GLint varyings = 0;
  glGetIntegerv(GL_MAX_VARYING_VECTORS, &varyings);
  StageTexts texts = hand_on_uniforms({active_lines(vertex.text), active_lines(fragment.text)}, fragment_uniforms(id_),
                                      varyings - kOwnVaryings);
  glDeleteProgram(std::exchange(id_, 0));
  build(std::move(texts.vertex), std::move(texts.fragment));
}

Program::Program(std::string_view name, const ShaderSource& compute)
    : name_(name), declared_(declared_uniforms(compute.text)) {
  const Shader shader(GL_COMPUTE_SHADER, name, {}, compute);
  id_ = glCreateProgram();
  glAttachShader(id_, shader.id);
  link();
}

Program::Program(Program&& other) noexcept
    : id_(std::exchange(other.id_, 0)),
      name_(std::move(other.name_)),
      declared_(std::move(other.declared_)),
      locations_(std::move(other.locations_)),
      units_(std::move(other.units_)),
      blocks_(std::move(other.blocks_)) {}

Program& Program::operator=(Program&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(name_, other.name_);
  std::swap(declared_, other.declared_);
  std::swap(locations_, other.locations_);
  std::swap(units_, other.units_);
  std::swap(blocks_, other.blocks_);
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
  list_blocks();
}

void Program::list_uniforms() {
  locations_.clear();
  units_.clear();
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
    if (place < 0) continue;  // of a block
    locations_[exact] = place;
    if (exact.ends_with("[0]")) locations_[exact.substr(0, exact.size() - 3)] = place;
    if (!is_sampler(type)) continue;
    const auto unit = static_cast<GLint>(units_.size());
    units_[exact] = unit;
    glProgramUniform1i(id_, place, unit);
  }
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &most);
  if (static_cast<GLint>(units_.size()) > most) {
    throw std::runtime_error(fmt::format("{} reads {} textures, the driver allows {}", name_, units_.size(), most));
  }
}

void Program::list_blocks() {
  blocks_.clear();
  GLint count = 0;
  glGetProgramiv(id_, GL_ACTIVE_UNIFORM_BLOCKS, &count);
  for (GLint i = 0; i < count; ++i) {
    const auto index = static_cast<GLuint>(i);
    GLint longest = 0;
    glGetActiveUniformBlockiv(id_, index, GL_UNIFORM_BLOCK_NAME_LENGTH, &longest);
    std::string name(static_cast<std::size_t>(longest), '\0');
    GLsizei length = 0;
    glGetActiveUniformBlockName(id_, index, longest, &length, name.data());
    blocks_[name.substr(0, static_cast<std::size_t>(length))] = i;
    glUniformBlockBinding(id_, index, index);
  }
}

void Program::use() const {
  glUseProgram(id_);
}

GLint Program::location(std::string_view uniform) const {
  const auto found = locations_.find(uniform);
  if (found != locations_.end()) return found->second;
  check_declared(uniform);
  return -1;
}

void Program::check_declared(std::string_view uniform) const {
  if (has(uniform.substr(0, uniform.find('[')))) return;
  throw std::logic_error(fmt::format("{} declares no uniform {}", name_, uniform));
}

void Program::bind(std::string_view sampler_name, TextureHandle texture, const Sampler* sampler) const {
  const auto unit = units_.find(sampler_name);
  if (unit == units_.end()) return check_declared(sampler_name);
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit->second));
  glBindTexture(texture.target, texture.id);
  glBindSampler(static_cast<GLuint>(unit->second), sampler == nullptr ? 0 : sampler->id());
}

void Program::bind_block(std::string_view block, const Buffer& buffer) const {
  const auto found = blocks_.find(block);
  if (found == blocks_.end()) throw std::logic_error(fmt::format("{} has no uniform block {}", name_, block));
  glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(found->second), buffer.id());
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
