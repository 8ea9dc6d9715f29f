// skyshaft render: a still of a scene's own view, or the time that its frames take.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/exit_status.h"
#include "app/options/gl_device.h"
#include "app/process/output_files.h"
#include "app/process/still.h"
#include "ar/error.h"
#include "render/base/median.h"
#include "render/plan/features/features.h"
#include "render/plan/renderer.h"

namespace app {
namespace {

struct RenderArguments {
  StillArguments still;
  std::filesystem::path output;
  bool overwrite = false;
  int frames = 0;
  bool json = false;
  std::optional<int> egl_device;
};

struct Timing {
  double frame_median_ms = 0.0;
  std::vector<std::pair<std::string, double>> pass_median_ms;  // in the order in which they run
};

bool is_exr(const std::filesystem::path& path) {
  return path.extension() == ".exr";
}

void check_arguments(const RenderArguments& arguments) {
  if (arguments.output.empty() && arguments.frames == 0) {
    throw UsageError("neither -o nor --frames: nothing to do\ngive -o OUT.exr, -o OUT.png or --frames N");
  }
  if (arguments.output.empty()) return;
  if (!is_exr(arguments.output) && arguments.output.extension() != ".png") {
    throw UsageError(
        fmt::format("-o: found '{}'; accepted: a name that ends in .exr (linear light) or .png (displayed)",
                    arguments.output.string()));
  }
  check_files({{"--scene", arguments.still.scene}}, {{"-o", arguments.output}}, arguments.overwrite);
}

double milliseconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Whole frames and single passes are timed in turns of their own: timing a pass waits for it to end, which a frame
// otherwise does not. The first frame fills caches and is not counted.
Timing time_frames(render::Renderer& renderer, const render::SceneState& state, const render::Plan& plan, int frames) {
  const auto draw = [&] { renderer.render_linear(state, plan); };
  draw();
  std::vector<double> frame_ms;
  for (int i = 0; i < frames; ++i) frame_ms.push_back(milliseconds_of(draw));
  renderer.enable_timing(true);
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> pass_ms;
  for (int i = 0; i < frames; ++i) {
    draw();
    for (const render::PassTime& pass : renderer.pass_times()) {
      if (!pass_ms.contains(pass.name)) order.push_back(pass.name);
      pass_ms[pass.name].push_back(pass.gpu_ms > 0.0 ? pass.gpu_ms : pass.wall_ms);
    }
  }
  renderer.enable_timing(false);
  Timing timing{.frame_median_ms = render::median(frame_ms, 0.0), .pass_median_ms = {}};
  for (const std::string& name : order) timing.pass_median_ms.emplace_back(name, render::median(pass_ms[name], 0.0));
  return timing;
}

nlohmann::ordered_json to_json(const Timing& timing, const RenderArguments& arguments) {
  nlohmann::ordered_json json{{"frame_median_ms", timing.frame_median_ms}, {"passes", nlohmann::json::array()}};
  for (const auto& [name, ms] : timing.pass_median_ms) json["passes"].push_back({{"name", name}, {"median_ms", ms}});
  json["frames"] = arguments.frames;
  return json;
}

void print_timing(const Timing& timing, const RenderArguments& arguments, const std::string& renderer_name) {
  std::cout << fmt::format("{:<12} {:9.3f} ms, median of {} frames on {}\n", "frame", timing.frame_median_ms,
                           arguments.frames, renderer_name);
  for (const auto& [name, ms] : timing.pass_median_ms) std::cout << fmt::format("{:<12} {:9.3f} ms\n", name, ms);
}

void write_still(render::Renderer& renderer, const render::SceneState& state, const render::Plan& plan,
                 const std::filesystem::path& output) {
  const render::LinearImage linear = renderer.render_linear(state, plan);
  if (is_exr(output)) {
    render::write_exr(output, linear);
  } else {
    render::write_png(output, renderer.display_image(linear, state.exposure));
  }
}

int run(const RenderArguments& arguments) {
  check_arguments(arguments);
  const Still still = make_still(arguments.still);
  if (!still.scene.view) {
    throw ar::InputError(
        fmt::format("{}: found no 'view'; accepted: where a still is seen from\n"
                    "add `view: {{ eye: [0, -6, 1.6], target: [0, 0, 1], vertical_fov_deg: 50 }}`",
                    arguments.still.scene.string()));
  }
  render::gl::Context context(arguments.egl_device);
  render::Renderer renderer(context);
  const render::Plan plan = render::make_plan(still.state, still.scene.quality, render::Target::Still);
  nlohmann::ordered_json report = nlohmann::ordered_json::object();
  if (!arguments.output.empty()) write_still(renderer, still.state, plan, arguments.output);
  if (arguments.frames > 0) {
    const Timing timing = time_frames(renderer, still.state, plan, arguments.frames);
    if (arguments.json) report = to_json(timing, arguments);
    if (!arguments.json) print_timing(timing, arguments, context.renderer_name());
  }
  if (!arguments.json) return kDone;
  report["size"] = arguments.still.size;
  if (plan.has(render::feature::kShafts)) report["shafts"] = render::to_text(plan.quality.shafts);
  if (const auto error = renderer.shafts_error()) {
    report["shafts_error"] = {{"mean_relative", error->mean}, {"largest_relative", error->largest}};
  }
  report["renderer"] = context.renderer_name();
  std::cout << report.dump() << '\n';
  return kDone;
}

}  // namespace

void add_render_command(CLI::App& app, Program& program) {
  CLI::App* command = app.add_subcommand("render", "Render a still of a scene's own view, or time its frames");
  auto arguments = std::make_shared<RenderArguments>();
  add_still_options(*command, arguments->still);
  command->add_option("-o,--output", arguments->output,
                      "OUT.exr: linear luminance, cd/m2, 32-bit float; OUT.png: exposed and displayed, 8 bits, sRGB");
  command->add_flag("--overwrite", arguments->overwrite, "Replace a file that exists");
  command->add_option("--frames", arguments->frames, "Time that many frames; default: none")
      ->check(CLI::Range(1, 100000));
  command->add_flag(
      "--json", arguments->json,
      "What was done as JSON: times in milliseconds, and the shafts' error where they estimate their own");
  add_gl_device_option(*command, arguments->egl_device);
  command->footer(
      "Examples:\n"
      "  skyshaft render --scene barn.yaml -o barn.png --size 1920x1080\n"
      "  skyshaft render --scene barn.yaml -o truth.exr --shafts reference --json\n"
      "  skyshaft render --scene barn.yaml --frames 50 --json\n"
      "  {\"frame_median_ms\":31.2,\"passes\":[{\"name\":\"shadow\",\"median_ms\":2.1}, ...]}");
  command->callback([arguments, &program] { program.action = [arguments] { return run(*arguments); }; });
}

}  // namespace app
