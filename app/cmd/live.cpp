// skyshaft live: what a camera sees, with a sunlit scene over it, as it happens.

#include "app/live/live.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>

#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/options/camera.h"
#include "app/options/encoder.h"
#include "app/options/gl_device.h"
#include "app/options/picture_size.h"
#include "app/options/shafts.h"

namespace app {
namespace {

struct LiveArguments {
  LiveOptions options;
  std::string size;  // WIDTHxHEIGHT
  std::vector<std::string> controls;
  bool list_cameras = false;
  std::string gpsd;
  const CLI::Option* gpsd_option = nullptr;
  std::string shafts;
};

void add_inputs(CLI::App& command, LiveArguments& arguments) {
  LiveOptions& options = arguments.options;
  command.add_option(
      "--source", options.source,
      "v4l2:/dev/video0, v4l2: (the first camera), libcamera:ID, libcamera: or file:CLIP, played once at "
      "its own rate as if a camera gave it");
  command.add_flag("--list-cameras", arguments.list_cameras,
                   "List the cameras that are there, with their modes, and end");
  command.add_option("-s,--scene", options.scene, "Scene file (YAML)");
  command.add_option("--size", arguments.size, "WIDTHxHEIGHT asked of the camera, pixels; default: near 1280x720");
  command.add_option("--rate", options.request.rate, "Frames a second asked of the camera; default: 30 or more")
      ->check(CLI::Range(0.1, 1000.0));
  command.add_option(
      "--format", options.request.format,
      "Format asked of the camera, as its driver writes it: YUYV, NV12, MJPG; default: what serves best");
  command.add_option("--control", arguments.controls,
                     "exposure (s), gain, focus or white-balance (K) =VALUE, =auto or =lock (stays as it is); may be "
                     "given again for others");
  add_camera_options(command, options.camera);
  command.add_option("--at", options.at, "LAT,LON[,HEIGHT]: degrees north, degrees east, metres; default: the scene's");
  command.add_option("--time", options.time,
                     "Time of the first frame, 2024-06-21T07:30:00Z or with an offset; default: scene, clip, now");
  arguments.gpsd_option =
      command
          .add_option("--gpsd", arguments.gpsd,
                      "Ask gpsd (HOST:PORT, or nothing for the local one) where this is, unless --at says")
          ->expected(0, 1);
  command
      .add_option("--reconnect", options.feed.reconnect_for_s,
                  "How long a camera that went away is waited for, seconds; 0: end with status 3; default: without end")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--duration", options.duration_s, "End after that many seconds; default: never")
      ->check(CLI::PositiveNumber);
}

void add_outputs(CLI::App& command, LiveArguments& arguments) {
  LiveOptions& options = arguments.options;
  command.add_flag("--headless", options.headless, "No window; no display is needed");
  command.add_flag("--full-screen", options.full_screen, "Begin with the window over the whole screen");
  command.add_option("--stills", options.stills, "Folder for the stills that `s` takes; default: the current one")
      ->check(CLI::ExistingDirectory);
  command.add_option("--record", options.record,
                     "Video file of what is shown (.mp4, .mkv, .mov), playable even when the program is killed");
  command.add_option("--output", options.outputs,
                     "V4L2 output device that other programs take for a webcam: v4l2:/dev/videoN, v4l2: (the first), "
                     "with :YUYV or :NV12 behind; may be given again");
  command.add_option("--poses", options.poses, "CSV of the camera's pose in every tracked frame");
  command.add_option("--report", options.report, "JSON of frame counts, latency and stage times");
  command.add_flag("--overwrite", options.sink.overwrite, "Replace files that exist");
  add_encoder_options(command, options.sink);
}

void add_rendering(CLI::App& command, LiveArguments& arguments) {
  command.add_option("--shafts", arguments.shafts, shafts_help());
  command
      .add_option("--target-ms", arguments.options.target_ms,
                  "Time that drawing a frame may take, milliseconds: quality is given up until it is kept; 0: full "
                  "quality, however long it takes; default: three quarters of the time between two frames")
      ->check(CLI::NonNegativeNumber);
  add_gl_device_option(command, arguments.options.egl_device);
}

ar::ControlSetting read_control(const std::string& text) {
  try {
    return ar::parse_control_setting(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(std::string("--control: ") + error.what());
  }
}

int run(LiveArguments arguments, bool quiet) {
  if (arguments.list_cameras) return list_cameras();
  LiveOptions& options = arguments.options;
  if (options.source.empty())
    throw UsageError("--source is required\nskyshaft live --list-cameras names what is there");
  if (options.scene.empty()) throw UsageError("--scene is required\nsee: skyshaft live --help");
  if (arguments.gpsd_option->count() > 0) options.gpsd = arguments.gpsd;
  if (!arguments.size.empty()) {
    const PictureSize size = parse_picture_size("--size", arguments.size);
    options.request.width = size.width;
    options.request.height = size.height;
  }
  for (const std::string& control : arguments.controls) options.request.controls.push_back(read_control(control));
  if (!arguments.shafts.empty()) options.shafts = parse_shafts("--shafts", arguments.shafts);
  options.quiet = quiet;
  return live(options);
}

}  // namespace

void add_live_command(CLI::App& app, Program& program) {
  CLI::App* command = app.add_subcommand("live", "Composite a scene, lit by the real sun and sky, over a camera");
  auto arguments = std::make_shared<LiveArguments>();
  arguments->options.sink.preset = "ultrafast";
  add_inputs(*command, *arguments);
  add_outputs(*command, *arguments);
  add_rendering(*command, *arguments);
  command->footer(
      "The newest frame wins: what is late is dropped and counted, and what is drawn always has its own frame's pose.\n"
      "Ctrl-C ends it and finalises the recording (status 130).\n\n"
      "Examples:\n"
      "  skyshaft live --source v4l2:/dev/video0 --scene garden.yaml --camera webcam.yaml --at 48.8584,2.2945\n"
      "  skyshaft live --source file:walk.mp4 --scene garden.yaml --headless --record lit.mp4 --report live.json");
  command->callback(
      [arguments, &program] { program.action = [arguments, &program] { return run(*arguments, program.quiet); }; });
}

}  // namespace app
