#include "app/options/gl_device.h"

#include <CLI/CLI.hpp>

namespace app {

void add_gl_device_option(CLI::App& command, std::optional<int>& device) {
  command
      .add_option("--egl-device", device,
                  "Number of the GL device as `skyshaft doctor` lists them; default: hardware first")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace app
