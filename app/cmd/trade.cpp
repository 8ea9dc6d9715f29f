// skyshaft trade: accuracy against speed of every way to compute a scene's light shafts.

#include "app/trade/trade.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/exit_status.h"
#include "app/options/gl_device.h"
#include "app/options/shafts.h"
#include "app/process/output_files.h"
#include "app/process/still.h"
#include "ar/error.h"

namespace app {
namespace {

struct TradeArguments {
  StillArguments still;
  TradeOptions options;
  std::filesystem::path folder;
  bool overwrite = false;
  std::optional<int> egl_device;
};

void check_arguments(const TradeArguments& arguments) {
  parse_shafts("--truth", arguments.options.truth);
  for (const std::string& settings : arguments.options.settings) parse_shafts("--setting", settings);
  std::filesystem::create_directories(arguments.folder);
  std::vector<NamedPath> outputs;
  for (const char* name : {"trade.csv", "trade.html", "truth.exr", "transmittance.exr"}) {
    outputs.push_back({name, arguments.folder / name});
  }
  check_files({{"--scene", arguments.still.scene}}, outputs, arguments.overwrite);
}

int run(const TradeArguments& arguments) {
  check_arguments(arguments);
  const Still still = make_still(arguments.still);
  if (!still.scene.view) {
    throw ar::InputError(
        fmt::format("{}: found no 'view'; accepted: where a still is seen from", arguments.still.scene.string()));
  }
  render::gl::Context context(arguments.egl_device);
  render::Renderer renderer(context);
  Trade trade = measure_trade(renderer, still.state, still.scene.quality, arguments.options,
                              [](const std::string& line) { spdlog::info("{}", line); });
  trade.scene = arguments.still.scene.stem().string();
  trade.renderer = context.renderer_name();
  write_whole(arguments.folder / "trade.csv", trade_csv(trade), arguments.overwrite);
  write_whole(arguments.folder / "trade.html", trade_html(trade), arguments.overwrite);
  render::write_exr(arguments.folder / "truth.exr", trade.truth.in_scattered());
  render::write_exr(arguments.folder / "transmittance.exr", trade.truth.transmittance());
  return kDone;
}

}  // namespace

void add_trade_command(CLI::App& app, Program& program) {
  CLI::App* command =
      app.add_subcommand("trade", "Measure accuracy against speed of every way to compute a scene's light shafts");
  auto arguments = std::make_shared<TradeArguments>();
  arguments->still.size = "640x360";
  add_still_options(*command, arguments->still);
  for (const char* chosen : {"--shafts", "--max-error", "--target-ms"}) {  // here everything is measured
    command->remove_option(command->get_option(chosen));
  }
  command
      ->add_option("-o,--output", arguments->folder,
                   "Folder for trade.csv, trade.html (one self-contained page), and the truth: truth.exr (in-scattered "
                   "luminance, cd/m2) and transmittance.exr")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace files that exist");
  command->add_option("--setting", arguments->options.settings,
                      "Measure this (as `render --shafts` reads it; may be given again) instead of every technique's "
                      "own range of settings");
  command->add_option("--truth", arguments->options.truth,
                      "What is measured against; default: reference:sky=open, the sun's shafts before a sky that "
                      "nothing hides. reference:sky=traced counts what hides the sky too, and is slow");
  command->add_option("--frames", arguments->options.frames, "Frames timed for each setting; default: 7")
      ->check(CLI::Range(1, 10000));
  add_gl_device_option(*command, arguments->egl_device);
  command->footer(
      "Examples:\n"
      "  skyshaft trade --scene gate.yaml -o gate-trade\n"
      "  skyshaft trade --scene gate.yaml -o few --size 1920x1080 --setting march:steps=64 --setting minmax");
  command->callback([arguments, &program] { program.action = [arguments] { return run(*arguments); }; });
}

}  // namespace app
