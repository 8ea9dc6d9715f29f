#include "render/gl/extensions.h"

#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace render::gl {
namespace {

thread_local const Extensions* current = nullptr;

std::set<std::string> extension_names() {
  std::set<std::string> names;
  GLint count = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i) {
    const GLubyte* name = glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
    if (name != nullptr) names.insert(reinterpret_cast<const char*>(name));
  }
  return names;
}

bool is_software() {
  const std::string_view renderer(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  return renderer.find("llvmpipe") != std::string_view::npos || renderer.find("softpipe") != std::string_view::npos;
}

template <typename Function>
void load(Function& function, const char* name) {
  function = reinterpret_cast<Function>(eglGetProcAddress(name));
}

}  // namespace

const Extensions& extensions() {
  if (current == nullptr) throw std::logic_error("no GL context is current on this thread");
  return *current;
}

namespace detail {

Extensions load_extensions() {
  const std::set<std::string> names = extension_names();
  Extensions e;
  if (names.contains("GL_KHR_debug")) {
    load(e.debug_message_callback, "glDebugMessageCallbackKHR");
    load(e.object_label, "glObjectLabelKHR");
    load(e.push_debug_group, "glPushDebugGroupKHR");
    load(e.pop_debug_group, "glPopDebugGroupKHR");
  }
  if (names.contains("GL_EXT_disjoint_timer_query")) {
    load(e.gen_queries, "glGenQueriesEXT");
    load(e.delete_queries, "glDeleteQueriesEXT");
    load(e.begin_query, "glBeginQueryEXT");
    load(e.end_query, "glEndQueryEXT");
    load(e.query_result_u64, "glGetQueryObjectui64vEXT");
  }
  e.software = is_software();
  e.color_buffer_float = names.contains("GL_EXT_color_buffer_float");
  e.color_buffer_half_float = e.color_buffer_float || names.contains("GL_EXT_color_buffer_half_float");
  e.float_blend = names.contains("GL_EXT_float_blend");
  e.float_linear = names.contains("GL_OES_texture_float_linear");
  return e;
}

void set_current_extensions(const Extensions* e) {
  current = e;
}

}  // namespace detail
}  // namespace render::gl
