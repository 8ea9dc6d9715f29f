#pragma once

#include <optional>

namespace CLI {
class App;
}

namespace app {

// --egl-device.
void add_gl_device_option(CLI::App& command, std::optional<int>& device);

}  // namespace app
