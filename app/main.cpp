// The skyshaft program: reads the command line, runs the chosen command, turns what it throws into an exit status.

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>
#include <string>

#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/exit_status.h"
#include "ar/error.h"
#include "render/shafts/reference/reference_technique.h"

namespace {

// One line of what, one of what to do.
void print_error(const std::string& message) {
  std::cerr << "skyshaft: " << message << '\n';
}

void set_up_logging(const app::Program& program) {
  auto logger = spdlog::stderr_color_mt("skyshaft");
  logger->set_pattern("%^%l%$: %v");
  logger->set_level(program.verbose ? spdlog::level::debug : program.quiet ? spdlog::level::warn : spdlog::level::info);
  spdlog::set_default_logger(logger);
}

void describe(CLI::App& cli, app::Program& program) {
  cli.name("skyshaft");
  cli.set_version_flag("--version", "skyshaft " SKYSHAFT_VERSION, "Print the version and exit");
  cli.set_help_flag("-h,--help", "Print this help and exit");
  cli.fallthrough();
  cli.require_subcommand(0, 1);
  cli.add_flag("-q,--quiet", program.quiet, "Warnings and errors only, no progress");
  cli.add_flag("-v,--verbose", program.verbose, "Debug messages on standard error");
  cli.footer(
      "Each command has its own page: skyshaft COMMAND --help\n\n"
      "Exit status: 0 done, 1 could not do it, 2 wrong usage, 3 input unreadable or device lost,\n"
      "4 calibration rejected by its own gates, 130 interrupted (the output is still finalised).\n\n"
      "Example:\n  skyshaft process walk.mp4 -o lit.mp4 --scene garden.yaml");
}

void add_commands(CLI::App& cli, app::Program& program) {
  app::add_process_command(cli, program);
  app::add_live_command(cli, program);
  app::add_render_command(cli, program);
  app::add_explain_command(cli, program);
  app::add_detect_command(cli, program);
  app::add_board_command(cli, program);
  app::add_calibrate_command(cli, program);
  app::add_camera_command(cli, program);
  app::add_map_command(cli, program);
  app::add_north_command(cli, program);
  app::add_sky_command(cli, program);
  app::add_sun_command(cli, program);
  app::add_synth_command(cli, program);
  app::add_trade_command(cli, program);
  app::add_contact_command(cli, program);
  app::add_doctor_command(cli, program);
}

// The page of the innermost command that was named, for the hint under a usage error.
std::string help_command(const CLI::App& cli) {
  const auto chosen = cli.get_subcommands();
  return chosen.empty() ? "skyshaft --help" : "skyshaft " + chosen.front()->get_name() + " --help";
}

int parse_and_run(int argc, char** argv) {
  app::Program program;
  CLI::App cli{"Puts virtual objects into real pictures, lit by the real sun and sky of that place and minute."};
  describe(cli, program);
  add_commands(cli, program);
  try {
    cli.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return cli.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    throw app::UsageError(std::string(error.what()) + "\nsee: " + help_command(cli));
  }
  if (!program.action) {
    std::cerr << cli.help();
    return app::kWrongUsage;
  }
  set_up_logging(program);
  return program.action();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    render::add_shaft_reference();
    return parse_and_run(argc, argv);
  } catch (const app::UsageError& error) {
    print_error(error.what());
    return app::kWrongUsage;
  } catch (const ar::InputError& error) {
    print_error(error.what());
    return app::kInputUnreadable;
  } catch (const std::exception& error) {
    print_error(error.what());
    return app::kFailed;
  }
}
