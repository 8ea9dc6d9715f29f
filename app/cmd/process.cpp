// skyshaft process: a recording in, a sunlit composite out.

#include "app/process/process.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/options/camera.h"
#include "app/options/encoder.h"
#include "app/options/frame_range.h"
#include "app/options/gl_device.h"
#include "app/options/shafts.h"

namespace app {
namespace {

// Values that need parsing after CLI11 is through with them.
struct ProcessArguments {
  ProcessOptions options;
  std::string frames;
  std::string shafts;
};

void add_inputs(CLI::App& command, ProcessArguments& arguments) {
  ProcessOptions& options = arguments.options;
  command.add_option("IN", options.input, "Video file, or pictures: 'shot_%04d.png', 'shots/*.jpg', a folder")
      ->required();
  command.add_option("-s,--scene", options.scene, "Scene file (YAML)")->required();
  add_camera_options(command, options.camera);
  command.add_option("--at", options.at,
                     "LAT,LON[,HEIGHT]: degrees north, degrees east, metres; default: scene, video");
  command.add_option("--time", options.time,
                     "Time of the first frame, 2024-06-21T07:30:00Z or with an offset; default: scene, video");
  command.add_option("--frames", arguments.frames, "FIRST:END, frames counted from 0, END not included; default: all");
  command.add_option("--rate", options.image_frame_rate, "Frames a second of a picture sequence; default: 25")
      ->check(CLI::Range(0.01, 1000.0));
  command.add_flag("--tone-map", options.tone_map,
                   "Bring HDR video (PQ, HLG) to standard range instead of refusing it");
}

void add_outputs(CLI::App& command, ProcessArguments& arguments) {
  ProcessOptions& options = arguments.options;
  command.add_option("-o,--output", options.output, "Video file (container by extension) or 'out_%04d.png'")
      ->required();
  command.add_option("--poses", options.poses, "CSV of the camera's pose in every frame");
  command.add_option("--report", options.report, "JSON of frame counts, stage and pass times, settings");
  command.add_flag("--overwrite", options.sink.overwrite, "Replace files that exist");
  add_encoder_options(command, options.sink);
}

void add_rendering(CLI::App& command, ProcessArguments& arguments) {
  command.add_option("--shafts", arguments.shafts, shafts_help());
  add_gl_device_option(command, arguments.options.egl_device);
}

int run(ProcessArguments arguments, bool quiet) {
  ProcessOptions& options = arguments.options;
  if (!arguments.frames.empty()) options.frames = parse_frame_range(arguments.frames);
  if (!arguments.shafts.empty()) options.shafts = parse_shafts("--shafts", arguments.shafts);
  options.quiet = quiet;
  return process(options);
}

}  // namespace

void add_process_command(CLI::App& app, Program& program) {
  CLI::App* command = app.add_subcommand("process", "Composite a scene, lit by the real sun and sky, over a recording");
  auto arguments = std::make_shared<ProcessArguments>();
  add_inputs(*command, *arguments);
  add_outputs(*command, *arguments);
  add_rendering(*command, *arguments);
  command->footer(
      "Frames keep their distances in time, the first at 0 (--poses: at the source's time); audio and subtitles are "
      "copied\n"
      "in step. Frames without a known tag go through unchanged.\n"
      "Ctrl-C finalises what is done so far (status 130).\n\n"
      "The poses are rows of frame,time_s,state,x_m,y_m,z_m,qw,qx,qy,qz,rms_px,tag_ids: the camera's place and\n"
      "orientation in the world (east, north, up; camera x right, y down, z forward).\n\n"
      "Examples:\n"
      "  skyshaft process walk.mp4 -o lit.mp4 --scene garden.yaml --camera phone.yaml --poses walk.csv\n"
      "  skyshaft process walk.mov -o lit.mkv --scene garden.yaml --fov 66 --at 48.8584,2.2945\n"
      "                   --time 2024-06-21T09:30+02:00 --codec ffv1 --frames 100:250");
  command->callback(
      [arguments, &program] { program.action = [arguments, &program] { return run(*arguments, program.quiet); }; });
}

}  // namespace app
