// skyshaft synth: a clip with exactly known camera path, tags and light, and the truth beside it.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/cmd/commands.h"
#include "app/exit_status.h"
#include "app/pipeline/interrupt.h"
#include "app/pipeline/progress.h"
#include "app/process/output_files.h"
#include "app/synth/clip.h"
#include "app/synth/spec.h"
#include "app/synth/truth.h"

namespace app {
namespace {

struct SynthArguments {
  std::string spec;
  std::string output;
  int frames = 0;
  bool overwrite = false;
};

int run(const SynthArguments& arguments, bool quiet) {
  synth::Spec spec = synth::read_spec(arguments.spec);
  const synth::TruthFiles truth(arguments.output);
  check_files({{"SPEC", arguments.spec}},
              {{"-o", arguments.output},
               {"the true poses", truth.poses},
               {"the true corners", truth.corners},
               {"the camera file", truth.camera},
               {"the scene file", truth.scene}},
              arguments.overwrite);
  if (arguments.frames > 0) spec.frames = arguments.frames;
  const InterruptGuard interrupt;
  Progress progress(spec.frames, quiet);
  synth::ClipOptions options;
  options.overwrite = arguments.overwrite;
  options.progress = [&](int done, int) { progress.update(done); };
  options.stop = [] { return InterruptGuard::requested(); };
  const int written = synth::write_clip(spec, arguments.output, options);
  return written < spec.frames ? kInterrupted : kDone;
}

}  // namespace

void add_synth_command(CLI::App& app, Program& program) {
  CLI::App* command = app.add_subcommand("synth", "Make a clip whose camera path, tags, lens and light are known");
  auto arguments = std::make_shared<SynthArguments>();
  command->add_option("SPEC", arguments->spec, "Spec file (YAML); docs/synth.md describes it")->required();
  command->add_option("-o,--output", arguments->output, "Video file, or pictures: 'shot_%04d.png'")->required();
  command
      ->add_option("--frames", arguments->frames,
                   "Number of frames, instead of the spec's; an orbit then takes that long")
      ->check(CLI::PositiveNumber);
  command->add_flag("--overwrite", arguments->overwrite, "Replace files that exist");
  command->footer(
      "Beside clip.mp4 appear:\n"
      "  clip.truth.csv    the camera in every frame, in the middle of its exposure; columns as process --poses\n"
      "  clip.corners.csv  every tag's true corners in pixels (centre of the first pixel 0,0), library's order\n"
      "  clip.camera.yaml  the lens, for --camera\n"
      "  clip.scene.yaml   place, time, tags, exposure and real things, for --scene\n\n"
      "Equal specs give equal pictures. Ctrl-C finalises what is done so far (status 130).\n\n"
      "Example:\n  skyshaft synth data/synth/demo.yaml -o clip.mp4 --frames 60");
  command->callback(
      [arguments, &program] { program.action = [arguments, &program] { return run(*arguments, program.quiet); }; });
}

}  // namespace app
