// skyshaft doctor: what this machine offers, what is missing and how to get it.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
}

#include "app/cmd/commands.h"
#include "app/exit_status.h"
#include "render/gl/context.h"

namespace app {
namespace {

// A codec under the name that FFmpeg's libraries know it by, and what Skyshaft calls it.
struct Codec {
  const char* ffmpeg_name;
  const char* name;
};

bool report_gl() {
  std::cout << "GL\n";
  for (const render::gl::EglDevice& device : render::gl::list_egl_devices()) {
    std::cout << fmt::format("  device {}  {}{}\n", device.index, device.name, device.software ? " (software)" : "");
  }
  try {
    const render::gl::Context context;
    std::cout << fmt::format("  used      {}, {}\n", context.renderer_name(), context.version());
    return true;
  } catch (const std::runtime_error& error) {
    std::cout << "  MISSING   " << error.what() << '\n';
    return false;
  }
}

bool report_codecs(const char* title, const std::vector<Codec>& codecs, const AVCodec* (*find)(const char*),
                   const char* how_to_get) {
  std::vector<std::string> present;
  std::vector<std::string> missing;
  for (const Codec& codec : codecs) (find(codec.ffmpeg_name) != nullptr ? present : missing).emplace_back(codec.name);
  std::cout << title << "\n  present   " << fmt::format("{}", fmt::join(present, ", ")) << '\n';
  if (missing.empty()) return true;
  std::cout << fmt::format("  MISSING   {}\n            {}\n", fmt::join(missing, ", "), how_to_get);
  return false;
}

// "/dev/video0  Integrated Camera" for every video node.
void report_cameras() {
  std::cout << "cameras\n";
  namespace fs = std::filesystem;
  std::error_code error;
  int found = 0;
  for (const auto& entry : fs::directory_iterator("/sys/class/video4linux", error)) {
    std::string name;
    std::getline(std::ifstream(entry.path() / "name"), name);
    std::cout << fmt::format("  /dev/{:<8}{}\n", entry.path().filename().string(), name);
    ++found;
  }
  if (found == 0) std::cout << "  none\n";
}

int run() {
  const bool gl = report_gl();
  const bool encoders = report_codecs("encoders", {{"libx264", "h264"}, {"libx265", "hevc"}, {"ffv1", "ffv1"}},
                                      avcodec_find_encoder_by_name, "apt-get install libavcodec-extra");
  const bool decoders = report_codecs("decoders",
                                      {{"h264", "h264"},
                                       {"hevc", "hevc"},
                                       {"vp9", "vp9"},
                                       {"libdav1d", "av1"},
                                       {"mjpeg", "mjpeg"},
                                       {"prores", "prores"},
                                       {"ffv1", "ffv1"},
                                       {"png", "png"}},
                                      avcodec_find_decoder_by_name, "apt-get install libavcodec-extra");
  report_cameras();
  return gl && encoders && decoders ? kDone : kFailed;
}

}  // namespace

void add_doctor_command(CLI::App& app, Program& program) {
  CLI::App* command = app.add_subcommand("doctor", "List GL devices, codecs and cameras, and what is missing");
  command->footer(
      "Status 0 when everything that `process` may need is there, 1 otherwise.\n\n"
      "Example:\n  skyshaft doctor");
  command->callback([&program] { program.action = [] { return run(); }; });
}

}  // namespace app
