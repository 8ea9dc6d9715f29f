#include "render/gl/egl_display.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <string_view>

namespace render::gl {
namespace {

bool has_word(const char* words, std::string_view word) {
  if (words == nullptr) return false;
  std::string_view rest(words);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == word) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

template <typename Function>
Function egl_function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::vector<EGLDeviceEXT> query_devices() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!has_word(client, "EGL_EXT_device_enumeration") && !has_word(client, "EGL_EXT_device_base")) return {};
  const auto query = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  EGLint count = 0;
  if (query == nullptr || query(0, nullptr, &count) != EGL_TRUE || count <= 0) return {};
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (query(count, devices.data(), &count) != EGL_TRUE) return {};
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

EglDevice describe(EGLDeviceEXT device, int index) {
  EglDevice out{.index = index, .name = "", .software = false};
  const auto query = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (query == nullptr) return out;
  const char* extensions = query(device, EGL_EXTENSIONS);
  out.software = has_word(extensions, "EGL_MESA_device_software");
  const char* name = nullptr;
  if (has_word(extensions, "EGL_EXT_device_query_name")) name = query(device, EGL_RENDERER_EXT);
  if (name == nullptr && has_word(extensions, "EGL_EXT_device_drm")) name = query(device, EGL_DRM_DEVICE_FILE_EXT);
  out.name = name != nullptr ? name : (out.software ? "software rasteriser" : "unnamed device");
  return out;
}

std::mutex& display_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::map<EGLDisplay, int>& display_users() {
  static std::map<EGLDisplay, int> users;
  return users;
}

}  // namespace

std::vector<EglDevice> list_egl_devices() {
  std::vector<EglDevice> out;
  for (const EGLDeviceEXT device : query_devices()) out.push_back(describe(device, static_cast<int>(out.size())));
  return out;
}

namespace detail {

std::vector<DisplayRoute> display_routes() {
  std::vector<DisplayRoute> routes;
  const auto get_display = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (get_display == nullptr) return routes;
  int index = 0;
  for (const EGLDeviceEXT device : query_devices()) {
    routes.push_back({describe(device, index++), get_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr)});
  }
  std::stable_sort(routes.begin(), routes.end(), [](const DisplayRoute& a, const DisplayRoute& b) {
    return static_cast<int>(a.device.software) < static_cast<int>(b.device.software);
  });
  if (has_word(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless")) {
    EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    routes.push_back({{.index = -1, .name = "surfaceless platform", .software = false}, display});
  }
  return routes;
}

bool open_display(EGLDisplay display) {
  if (display == EGL_NO_DISPLAY) return false;
  const std::lock_guard lock(display_mutex());
  int& users = display_users()[display];
  if (users == 0 && eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return false;
  ++users;
  return true;
}

void close_display(EGLDisplay display) {
  const std::lock_guard lock(display_mutex());
  if (--display_users()[display] == 0) eglTerminate(display);
}

std::string egl_error() {
  const EGLint error = eglGetError();
  switch (error) {
    case EGL_SUCCESS:
      return "no reason given";
    case EGL_NOT_INITIALIZED:
      return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS:
      return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC:
      return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE:
      return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG:
      return "EGL_BAD_CONFIG";
    case EGL_BAD_DISPLAY:
      return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH:
      return "EGL_BAD_MATCH";
    default:
      return fmt::format("EGL error 0x{:04x}", error);
  }
}

}  // namespace detail
}  // namespace render::gl
