#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace app {

// What the command line settled on. The chosen subcommand's callback sets `action`; main runs it and ends with the
// status it returns (app/exit_status.h). Errors are thrown: app::UsageError, ar::InputError, std::exception.
struct Program {
  bool verbose = false;  // -v, --verbose: debug messages on stderr
  bool quiet = false;    // -q, --quiet: warnings and errors only, no progress
  std::function<int()> action;
};

// One function a subcommand, each in app/cmd_NAME.cpp: adds its options to `app` and sets program.action when chosen.
// To add one: declare it here, call it in app/main.cpp, list its source in app/CMakeLists.txt.
void add_board_command(CLI::App& app, Program& program);
void add_calibrate_command(CLI::App& app, Program& program);
void add_camera_command(CLI::App& app, Program& program);
void add_contact_command(CLI::App& app, Program& program);
void add_detect_command(CLI::App& app, Program& program);
void add_doctor_command(CLI::App& app, Program& program);
void add_explain_command(CLI::App& app, Program& program);
void add_live_command(CLI::App& app, Program& program);
void add_map_command(CLI::App& app, Program& program);
void add_north_command(CLI::App& app, Program& program);
void add_process_command(CLI::App& app, Program& program);
void add_render_command(CLI::App& app, Program& program);
void add_sky_command(CLI::App& app, Program& program);
void add_sun_command(CLI::App& app, Program& program);
void add_synth_command(CLI::App& app, Program& program);
void add_trade_command(CLI::App& app, Program& program);

}  // namespace app
