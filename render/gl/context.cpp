#include "render/gl/context.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <stdexcept>

#include "render/gl/egl_display.h"
#include "render/gl/extensions.h"

namespace render::gl {
namespace {

void GL_APIENTRY log_message(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message,
                             const void*) {
  if (severity == GL_DEBUG_SEVERITY_NOTIFICATION_KHR || type == GL_DEBUG_TYPE_PUSH_GROUP_KHR ||
      type == GL_DEBUG_TYPE_POP_GROUP_KHR) {
    return;
  }
  const bool grave = type == GL_DEBUG_TYPE_ERROR_KHR || severity == GL_DEBUG_SEVERITY_HIGH_KHR;
  spdlog::log(grave ? spdlog::level::warn : spdlog::level::debug, "GL: {}", message);
}

std::string route_name(const detail::DisplayRoute& route) {
  if (route.device.index < 0) return route.device.name;
  return fmt::format("EGL device {} ({})", route.device.index, route.device.name);
}

constexpr const char* kInstallHint =
    "Install a driver: on Debian `apt-get install libegl1 libgles2 libgl1-mesa-dri` (Mesa, works without a GPU), or "
    "the GPU vendor's own EGL library; `skyshaft doctor` lists what is found.";

}  // namespace

struct Context::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  Extensions extensions;
  std::string renderer;
  std::string version;

  ~Impl() {
    if (display == EGL_NO_DISPLAY) return;
    if (context != EGL_NO_CONTEXT) {
      if (eglGetCurrentContext() == context) release();
      eglDestroyContext(display, context);
    }
    detail::close_display(display);
  }

  void make_current() const {
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
      throw std::runtime_error("eglMakeCurrent: " + detail::egl_error());
    }
    detail::set_current_extensions(&extensions);
  }

  void release() const {
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    detail::set_current_extensions(nullptr);
  }

  // Opens a context by that route; throws std::runtime_error with the step that failed.
  void open(const detail::DisplayRoute& route) {
    if (!detail::open_display(route.display)) throw std::runtime_error("eglInitialize: " + detail::egl_error());
    display = route.display;
    create_context();
    make_current();
    extensions = detail::load_extensions();
    renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    extensions.software = extensions.software || route.device.software;
    if (!extensions.color_buffer_half_float) {
      throw std::runtime_error(renderer + " cannot render to half-float textures (EXT_color_buffer_half_float)");
    }
    if (extensions.debug_message_callback != nullptr && spdlog::should_log(spdlog::level::debug)) {
      glEnable(GL_DEBUG_OUTPUT_KHR);
      extensions.debug_message_callback(log_message, nullptr);
    }
  }

  void create_context() {
    if (eglBindAPI(EGL_OPENGL_ES_API) != EGL_TRUE) throw std::runtime_error("eglBindAPI: " + detail::egl_error());
    const EGLint config_wish[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglChooseConfig(display, config_wish, &config, 1, &count) != EGL_TRUE || count < 1) {
      throw std::runtime_error("no OpenGL ES 3 configuration: " + detail::egl_error());
    }
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
    context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) throw std::runtime_error("no OpenGL ES 3.1 context: " + detail::egl_error());
  }
};

Context::Context(std::optional<int> egl_device) {
  std::string attempts;
  for (const detail::DisplayRoute& route : detail::display_routes()) {
    if (egl_device && route.device.index != *egl_device) continue;
    try {
      impl_ = std::make_unique<Impl>();
      impl_->open(route);
      spdlog::debug("GL: {}: {}, {}", route_name(route), impl_->renderer, impl_->version);
      return;
    } catch (const std::runtime_error& error) {
      impl_.reset();
      spdlog::debug("GL: {}: {}", route_name(route), error.what());
      attempts += fmt::format("; {}: {}", route_name(route), error.what());
    }
  }
  if (attempts.empty()) {
    const std::size_t count = list_egl_devices().size();
    attempts = egl_device ? fmt::format("; no EGL device {}, EGL offers {} (0 to {})", *egl_device, count,
                                        static_cast<long>(count) - 1)
                          : "; EGL offers no device and no surfaceless platform";
  }
  throw std::runtime_error(fmt::format("no OpenGL ES 3.1 context{}\n{}", attempts, kInstallHint));
}

Context::~Context() = default;

void Context::make_current() {
  impl_->make_current();
}
void Context::release() {
  impl_->release();
}
const std::string& Context::renderer_name() const {
  return impl_->renderer;
}
const std::string& Context::version() const {
  return impl_->version;
}
bool Context::is_software() const {
  return impl_->extensions.software;
}

}  // namespace render::gl
