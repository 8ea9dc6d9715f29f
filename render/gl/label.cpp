#include "render/gl/label.h"

#include <algorithm>

#include "render/gl/extensions.h"

namespace render::gl {
namespace {

GLenum identifier(LabelKind kind) {
  switch (kind) {
    case LabelKind::Program:
      return GL_PROGRAM_KHR;
    case LabelKind::Texture:
      return GL_TEXTURE;
    case LabelKind::Framebuffer:
      return GL_FRAMEBUFFER;
    case LabelKind::Buffer:
      return GL_BUFFER_KHR;
  }
  return 0;
}

}  // namespace

void label(LabelKind kind, GLuint id, std::string_view name) {
  constexpr std::size_t kLongest = 255;  // GL promises 256 with the terminator
  if (!extensions().has_labels()) return;
  extensions().object_label(identifier(kind), id, static_cast<GLsizei>(std::min(name.size(), kLongest)), name.data());
}

DebugGroup::DebugGroup(const std::string& name) {
  if (extensions().push_debug_group != nullptr) {
    extensions().push_debug_group(GL_DEBUG_SOURCE_APPLICATION_KHR, 0, -1, name.c_str());
  }
}

DebugGroup::~DebugGroup() {
  if (extensions().pop_debug_group != nullptr) extensions().pop_debug_group();
}

}  // namespace render::gl
