#pragma once

#include <GLES3/gl31.h>

#include <string>
#include <string_view>

namespace render::gl {

enum class LabelKind { Program, Texture, Framebuffer, Buffer };

// Names an object for GL debuggers and driver messages, where KHR_debug is there. The object must have been bound once.
void label(LabelKind kind, GLuint id, std::string_view name);

// A named stretch of GL calls in a debugger's list, from construction to destruction.
class DebugGroup {
 public:
  explicit DebugGroup(const std::string& name);
  ~DebugGroup();
  DebugGroup(const DebugGroup&) = delete;
  DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace render::gl
