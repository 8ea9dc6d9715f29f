#pragma once

#include <GLES3/gl31.h>

#include <glm/glm.hpp>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

#include "render/gl/buffer.h"
#include "render/gl/sampler.h"
#include "render/gl/shader_source.h"
#include "render/gl/texture.h"

namespace render::gl {

// A linked program made of embedded shaders. Move-only. Throws std::runtime_error with the driver's log, in which
// places are written as file and line of the file below shaders/, included files too.
class Program {
 public:
  Program(std::string_view vertex_path, std::string_view fragment_path, const Defines& defines = {});
  // A compute program, of the shader of that name.
  Program(std::string_view name, const ShaderSource& compute);
  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;
  ~Program();

  void use() const;
  GLuint id() const { return id_; }
  const std::string& name() const { return name_; }

  // Whether the program's sources declare that uniform, sampler or member of a uniform block in this variant.
  bool has(std::string_view uniform) const { return declared_.contains(uniform); }

  // Set a uniform of the program (which need not be in use). Throws std::logic_error for one that it does not declare;
  // one that its compiler found no use for is ignored. Arrays are set by their first element's name, "weights", members
  // of arrays of structs as "maps[1].texel".
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

  // Binds a texture to the unit that the program's sampler of that name has. Units are handed out when the program is
  // linked, one to each sampler that is in use. Without `sampler` the texture's own filters count. Throws as set().
  void bind(std::string_view sampler_name, TextureHandle texture, const Sampler* sampler = nullptr) const;
  // Binds a buffer to a uniform block ("layout(std140) uniform Name {"). Throws std::logic_error where there is none.
  void bind_block(std::string_view block, const Buffer& buffer) const;

 private:
  struct StringHash {
    using is_transparent = void;
    std::size_t operator()(std::string_view s) const { return std::hash<std::string_view>{}(s); }
  };

  using Names = std::unordered_map<std::string, GLint, StringHash, std::equal_to<>>;

  GLint location(std::string_view uniform) const;
  void check_declared(std::string_view uniform) const;
  void link();
  void list_uniforms();
  void list_blocks();

  GLuint id_ = 0;
  std::string name_;
  std::set<std::string, std::less<>> declared_;
  Names locations_;  // of uniforms in use
  Names units_;      // of samplers in use
  Names blocks_;     // binding points
};

}  // namespace render::gl
