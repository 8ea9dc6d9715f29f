#pragma once

#include <GLES3/gl31.h>

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <unordered_map>

#include "render/gl/shader_source.h"

namespace render::gl {

// A linked program made of embedded shaders. Move-only. Throws std::runtime_error with the driver's log, in which
// places are written as file and line of the file below shaders/, included files too.
class Program {
 public:
  Program(std::string_view vertex_path, std::string_view fragment_path, const Defines& defines = {});
  explicit Program(std::string_view compute_path, const Defines& defines = {});
  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;
  ~Program();

  void use() const;
  GLuint id() const { return id_; }
  const std::string& name() const { return name_; }

  // Set a uniform of the program (which need not be in use). A name that the compiler has optimised away, or that
  // this variant lacks, is ignored. Arrays are set by their first element's name, "cascade[0]" or "cascade".
  void set(std::string_view uniform, int value) const;
  void set(std::string_view uniform, float value) const;
  void set(std::string_view uniform, const glm::vec2& value) const;
  void set(std::string_view uniform, const glm::vec3& value) const;
  void set(std::string_view uniform, const glm::vec4& value) const;
  void set(std::string_view uniform, const glm::ivec2& value) const;
  void set(std::string_view uniform, const glm::ivec4& value) const;
  void set(std::string_view uniform, const glm::mat3& value) const;
  void set(std::string_view uniform, const glm::mat4& value) const;
  void set(std::string_view uniform, const glm::vec3* values, int count) const;
  void set(std::string_view uniform, const glm::vec4* values, int count) const;

 private:
  struct StringHash {
    using is_transparent = void;
    std::size_t operator()(std::string_view s) const { return std::hash<std::string_view>{}(s); }
  };

  GLint location(std::string_view uniform) const;
  void link();
  void list_uniforms();

  GLuint id_ = 0;
  std::string name_;
  std::unordered_map<std::string, GLint, StringHash, std::equal_to<>> locations_;
};

}  // namespace render::gl
