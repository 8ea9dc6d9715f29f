#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>
#include <vector>

#include "render/gl/context.h"

namespace render::gl::detail {

// A way to a display: an EGL device, or the surfaceless platform.
struct DisplayRoute {
  EglDevice device;              // index -1: surfaceless
  EGLDisplay display = nullptr;  // not initialised yet
};

// Devices with hardware first, then the surfaceless platform.
std::vector<DisplayRoute> display_routes();

// eglInitialize and eglTerminate act on a display that all contexts of the process share: this counts the users.
// open_display() returns false where EGL refuses it.
bool open_display(EGLDisplay display);
void close_display(EGLDisplay display);

// The last EGL error as text.
std::string egl_error();

}  // namespace render::gl::detail
