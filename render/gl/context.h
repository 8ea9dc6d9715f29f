#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace render::gl {

// A device that EGL offers.
struct EglDevice {
  int index = 0;
  std::string name;  // EGL_RENDERER or DRM file, what the driver tells
  bool software = false;
};
std::vector<EglDevice> list_egl_devices();

// Headless OpenGL ES 3.1 context, current on the thread that made it. Tries EGL devices (hardware first), then the
// surfaceless platform; each attempt is logged at debug level, and all of them in the error.
class Context {
 public:
  // Throws std::runtime_error with every attempt's reason and the Debian packages to install.
  explicit Context(std::optional<int> egl_device = std::nullopt);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void make_current();  // moves the context to the calling thread; release() it on the other first
  void release();

  const std::string& renderer_name() const;  // GL_RENDERER
  const std::string& version() const;        // GL_VERSION
  bool is_software() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render::gl
