// skyshaft explain: what a frame of a scene would run, and why.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/cmd/commands.h"
#include "app/exit_status.h"
#include "app/process/still.h"
#include "render/plan/plan.h"

namespace app {
namespace {

void print_instances(const render::SceneState& state) {
  std::cout << fmt::format("things\n");
  for (const render::Instance& instance : state.instances) {
    std::cout << fmt::format("  {:<10} {:<24} {} triangles\n", instance.real ? "real" : "virtual", instance.name,
                             instance.model->triangle_count());
  }
}

void print_plan(const render::Plan& plan) {
  std::cout << "passes\n";
  for (const render::Pass& pass : plan.passes) {
    std::cout << fmt::format("  {:<12} {}\n               because {}\n", pass.feature->name, pass.settings,
                             pass.reason);
  }
  if (plan.omitted.empty()) return;
  std::cout << "left out\n";
  for (const render::Omission& omission : plan.omitted) {
    std::cout << fmt::format("  {:<12} because {}\n", omission.feature->name, omission.reason);
  }
}

// A scene with a view and no tags is one for stills.
render::Target target_of(const SceneFile& scene) {
  return scene.view && !scene.tags ? render::Target::Still : render::Target::Video;
}

int run(const StillArguments& arguments) {
  const Still still = make_still(arguments);
  const render::Target target = target_of(still.scene);
  std::cout << (target == render::Target::Still ? "a still of the scene's view\n" : "a frame of a video\n");
  print_instances(still.state);
  print_plan(render::make_plan(still.state, still.scene.quality, target));
  return kDone;
}

}  // namespace

void add_explain_command(CLI::App& app, Program& program) {
  CLI::App* command = app.add_subcommand("explain", "Print what a frame of a scene would run, and why; needs no GL");
  auto arguments = std::make_shared<StillArguments>();
  add_still_options(*command, *arguments);
  command->footer("Example:\n  skyshaft explain --scene garden.yaml --time 2024-06-21T19:30:00Z");
  command->callback([arguments, &program] { program.action = [arguments] { return run(*arguments); }; });
}

}  // namespace app
