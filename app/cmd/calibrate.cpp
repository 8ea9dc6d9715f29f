// skyshaft calibrate: a camera's lens from pictures of a board, and how well it is known.

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/calibration/board_file.h"
#include "app/calibration/gather.h"
#include "app/calibration/gather_live.h"
#include "app/calibration/summary.h"
#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/exit_status.h"
#include "app/options/picture_size.h"
#include "app/process/output_files.h"
#include "ar/error.h"
#include "calib/boards/board_check.h"

namespace app {
namespace {

struct CalibrateArguments {
  GatherOptions gather;
  LiveGatherOptions live;
  std::string live_size;  // WIDTHxHEIGHT
  std::string board;
  std::string output;
  std::string format = "opencv";
  std::string report;
  std::string lens = "auto";
  std::vector<std::string> solve;
  double board_sigma_mm = 0.0;
  bool accept = false;
  bool overwrite = false;
};

calib::CameraFormat format_of(const std::string& name) {
  if (name == "ros") return calib::CameraFormat::Ros;
  return name == "kalibr" ? calib::CameraFormat::Kalibr : calib::CameraFormat::OpenCv;
}

calib::SolveOptions solve_options(const CalibrateArguments& arguments) {
  calib::SolveOptions options;
  for (const std::string& what : arguments.solve) {
    options.solve_flatness = options.solve_flatness || what == "flatness";
    options.solve_layout = options.solve_layout || what == "layout";
  }
  options.board_sigma_m = arguments.board_sigma_mm / 1000.0;
  return options;
}

void choose_lens(const CalibrateArguments& arguments, Calibration& c) {
  if (arguments.lens != "auto") {
    c.options.lens = calib::lens_choice_from(arguments.lens);
    return;
  }
  const auto lens = calib::choose_lens(c.board, c.gathered.observations, c.options, &c.trials);
  c.options.lens = lens.value_or(calib::LensChoice::PlumbBob4);
}

// A board file of another board explains bad corners better than anything else does.
void check_board(Calibration& c) {
  const bool poor = c.solution.rms_px > 0.5 || c.solution.points_rejected > 0.1 * c.solution.points_used ||
                    c.assessment.verdict == calib::Verdict::Rejected;
  if (!poor) return;
  const auto wrong = calib::wrong_step(c.board, c.gathered.observations.views, 0.06);
  if (!wrong) return;
  const std::string what = fmt::format(
      "the board file does not fit the pictures: from tag {} to tag {} they show {:+.2f} tag sizes right and {:+.2f} "
      "down, the file says {:+.2f} and {:+.2f}",
      wrong->from_id, wrong->to_id, wrong->measured.x, wrong->measured.y, wrong->expected.x, wrong->expected.y);
  c.assessment.diagnostics.insert(
      c.assessment.diagnostics.begin(),
      {true, what, "correct the gaps, sizes or ids in the board file; skyshaft board --check"});
  c.assessment.verdict = calib::Verdict::Rejected;
}

std::string today() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::now()));
}

// Nothing when it was interrupted.
std::optional<Calibration> calibrate(const CalibrateArguments& arguments) {
  Calibration c;
  c.board = read_board(arguments.board);
  c.date = today();
  c.gathered = arguments.live.source.empty() ? gather(c.board, arguments.gather) : gather_live(c.board, arguments.live);
  if (c.gathered.interrupted) return std::nullopt;
  spdlog::debug("{} views of the board", c.gathered.observations.views.size());
  c.options = solve_options(arguments);
  choose_lens(arguments, c);
  const auto solution = calib::solve(c.board, c.gathered.observations, c.options);
  if (!solution) {
    const auto wrong = calib::wrong_step(c.board, c.gathered.observations.views, 0.06);
    throw std::runtime_error(fmt::format("no camera explains the {} views of the board\n{}",
                                         c.gathered.observations.views.size(),
                                         wrong ? "the board file does not fit the pictures: see skyshaft board --check"
                                               : "add views of the board, tilted different ways"));
  }
  c.solution = *solution;
  c.assessment = calib::assess(c.board, c.gathered.observations, c.solution, c.options);
  check_board(c);
  return c;
}

void check_outputs(const CalibrateArguments& arguments) {
  const std::string& live = arguments.live.source;
  std::vector<NamedPath> inputs{{"--board", arguments.board},
                                {"--corners-cache", arguments.gather.corners_cache},
                                {"--live", live.starts_with("file:") ? live.substr(5) : ""}};
  for (const std::string& input : arguments.gather.inputs) inputs.push_back({"input", input});
  check_files(inputs, {{"-o", arguments.output}, {"--report", arguments.report}}, arguments.overwrite);
}

// What failed, what to do, and whether there is a file now: status 4 says the first either way.
void tell_rejected(const CalibrateArguments& arguments, const calib::Diagnostic& why) {
  std::cerr << "skyshaft: calibration rejected: " << why.what << '\n' << why.to_do;
  if (arguments.accept && !arguments.output.empty()) {
    std::cerr << "\n" << arguments.output << " was written all the same, because of --accept; the status stays 4";
  } else if (!arguments.output.empty()) {
    std::cerr << "; " << arguments.output << " was not written: --accept writes it all the same (the status stays 4)";
  }
  std::cerr << '\n';
}

// The options of --live, made whole. Throws UsageError.
void complete_live_options(CalibrateArguments& arguments) {
  LiveGatherOptions& live = arguments.live;
  if (live.source.empty() && arguments.gather.inputs.empty()) {
    throw UsageError("give pictures, recordings, or --live SOURCE\nsee: skyshaft calibrate --help");
  }
  if (!live.source.empty() && !arguments.gather.corners_cache.empty()) {
    throw UsageError("--corners-cache is for pictures and recordings\nleave it out with --live");
  }
  live.most_views = arguments.gather.most_views;
  if (arguments.live_size.empty()) return;
  const PictureSize size = parse_picture_size("--size", arguments.live_size);
  live.request.width = size.width;
  live.request.height = size.height;
}

int run(CalibrateArguments arguments) {
  complete_live_options(arguments);
  check_outputs(arguments);
  const std::optional<Calibration> done = calibrate(arguments);
  if (!done) return kInterrupted;
  const Calibration& c = *done;
  if (!arguments.report.empty()) write_whole(arguments.report, report_html(c), arguments.overwrite);
  const bool rejected = c.assessment.verdict == calib::Verdict::Rejected;
  if (!arguments.output.empty() && (!rejected || arguments.accept)) {
    write_whole(arguments.output, calib::camera_text(c.solution.camera, format_of(arguments.format), note_of(c)),
                arguments.overwrite);
  }
  std::cout << summary_text(c) << std::flush;
  if (rejected) tell_rejected(arguments, c.assessment.diagnostics.front());
  return rejected ? kCalibrationRejected : kDone;
}

void add_live_options(CLI::App& command, CalibrateArguments& arguments, CLI::Option& input) {
  LiveGatherOptions& options = arguments.live;
  CLI::Option* live =
      command
          .add_option("--live", options.source,
                      "Instead of pictures: v4l2:/dev/video0, v4l2: (the first camera), libcamera:ID, libcamera: or "
                      "file:CLIP, played once at its own rate; views are taken as the board is held still")
          ->excludes(&input);
  command.add_flag("--headless", options.headless, "Of --live: no window; says on standard error what to hold next")
      ->needs(live);
  command.add_option("--rate", options.request.rate, "Of --live: frames a second asked of the camera")
      ->needs(live)
      ->check(CLI::Range(0.1, 1000.0));
  command
      .add_option("--size", arguments.live_size, "Of --live: WIDTHxHEIGHT asked of the camera; default: near 1280x720")
      ->needs(live);
}

void add_options(CLI::App& command, CalibrateArguments& arguments) {
  CLI::Option* input =
      command.add_option("input", arguments.gather.inputs, "Pictures, folders or patterns of pictures, recordings");
  add_live_options(command, arguments, *input);
  command.add_option("--board", arguments.board, "Board file, tag map, Kalibr target or short form; see below")
      ->required();
  command.add_option("-o,--output", arguments.output, "Camera file to write");
  command.add_option("--format", arguments.format, "Its format: opencv, ros or kalibr")
      ->check(CLI::IsMember({"opencv", "ros", "kalibr"}))
      ->capture_default_str();
  command.add_option("--report", arguments.report, "HTML page with plots to write");
  std::vector<std::string> lenses = calib::lens_choice_names();
  lenses.insert(lenses.begin(), "auto");
  command.add_option("--lens", arguments.lens, "Lens model; auto: the simplest that predicts views it was not shown")
      ->check(CLI::IsMember(lenses))
      ->capture_default_str();
  command.add_option("--solve", arguments.solve, "Errors of the board to solve for as well: flatness, layout")
      ->delimiter(',')
      ->check(CLI::IsMember({"flatness", "layout"}));
  command
      .add_option("--board-sigma", arguments.board_sigma_mm,
                  "Expected size of those errors, mm; default: 1 % of a square or tag")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--views", arguments.gather.most_views,
                  "Most views to choose from a recording, or to take with --live")
      ->check(CLI::Range(3, 1000))
      ->capture_default_str();
  command.add_option("--corners-cache", arguments.gather.corners_cache,
                     "File that keeps the corners found, so that solving again takes seconds");
  command.add_flag("--accept", arguments.accept,
                   "Write the camera file even if the calibration is rejected; the status is 4 all the same");
  command.add_flag("--overwrite", arguments.overwrite, "Replace files that exist");
}

}  // namespace

void add_calibrate_command(CLI::App& app, Program& program) {
  CLI::App* command =
      app.add_subcommand("calibrate", "A camera's lens from pictures of a board, and how well it is known");
  auto arguments = std::make_shared<CalibrateArguments>();
  add_options(*command, *arguments);
  command->footer(
      std::string(kBoardHelp) +
      "\n\nStatus 4: the calibration fails its own gates; docs/calibration.md lists them. The camera file is then\n"
      "written only with --accept, and the status is 4 all the same.\n\n"
      "Examples:\n  skyshaft calibrate left*.jpg --board chessboard:9x6:25mm -o camera.yaml --report report.html\n"
      "  skyshaft calibrate --live v4l2: --board charuco.yaml -o camera.yaml");
  command->callback([arguments, &program] {
    program.action = [arguments, &program] {
      arguments->gather.quiet = program.quiet;
      return run(*arguments);
    };
  });
}

}  // namespace app
