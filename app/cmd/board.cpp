// skyshaft board: a board to print, and a photograph of one held against its file.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "app/calibration/board_check_text.h"
#include "app/calibration/board_file.h"
#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/exit_status.h"
#include "app/process/output_files.h"
#include "calib/boards/board_drawing.h"
#include "render/base/whole_file.h"

namespace app {
namespace {

struct BoardArguments {
  std::string board;
  std::string output;
  std::string photo;
  calib::PaperOptions paper;
  double dpi = 300.0;
  bool overwrite = false;
};

int run(const BoardArguments& arguments) {
  if (arguments.output.empty() == arguments.photo.empty()) {
    throw UsageError(
        "one of -o and --check\n-o board.pdf writes the board, --check PHOTO compares a photograph with it");
  }
  const calib::Board board = read_board(arguments.board);
  if (!arguments.photo.empty()) {
    const BoardCheck check = check_board_photo(board, arguments.photo);
    std::cout << check.text;
    return check.fits ? kDone : kFailed;
  }
  const auto yaml = std::filesystem::path(arguments.output).replace_extension(".yaml");
  check_files({{"SPEC", arguments.board}}, {{"-o", arguments.output}, {"the board's file", yaml}}, arguments.overwrite);
  const auto pages = calib::draw_board(board, arguments.paper);
  // Written beside and renamed, so that no half of a file is ever there.
  std::filesystem::path beside = arguments.output;
  beside.replace_filename("." + beside.stem().string() + ".part" + beside.extension().string());
  try {
    calib::write_pages(beside.string(), pages, arguments.dpi);
    render::rename_whole(beside, arguments.output,
                         arguments.overwrite ? render::Existing::Replace : render::Existing::Keep);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw;
  }
  write_whole(yaml, board_text(board), arguments.overwrite);
  std::cout << fmt::format(
      "{}\n{}: {} page{} of {:g} x {:g} mm; {}: the board, for --board\nprint at 100 %, without \"fit "
      "to page\", then measure the ruler: {:g} mm\n",
      board.description, arguments.output, pages.size(), pages.size() == 1 ? "" : "s", pages[0].width_mm,
      pages[0].height_mm, yaml.string(), pages[0].ruler_mm);
  return kDone;
}

}  // namespace

void add_board_command(CLI::App& app, Program& program) {
  CLI::App* command =
      app.add_subcommand("board", "A calibration board to print at true scale, or one checked in a photograph");
  auto arguments = std::make_shared<BoardArguments>();
  command->add_option("SPEC", arguments->board, "The board; see below")->required();
  command->add_option("-o,--output", arguments->output, "board.pdf, .svg or .png; the board's file appears beside it");
  command->add_option("--check", arguments->photo, "Photograph to compare with the board");
  command->add_option("--paper", arguments->paper.paper, "auto, a4, a3, a2, a1, a0, letter, tabloid")
      ->check(CLI::IsMember({"auto", "a4", "a3", "a2", "a1", "a0", "letter", "tabloid"}))
      ->capture_default_str();
  command->add_option("--margin", arguments->paper.margin_mm, "Of the paper, mm, that the printer leaves white")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command->add_option("--dpi", arguments->dpi, "Dots an inch of a PNG")
      ->check(CLI::Range(30.0, 2400.0))
      ->capture_default_str();
  command->add_flag("--overwrite", arguments->overwrite, "Replace files that exist");
  command->footer(std::string(kBoardHelp) +
                  "\n\nExamples:\n  skyshaft board aprilgrid:5x7:30mm:0.3 -o board.pdf\n"
                  "  skyshaft board board.yaml --check photo.jpg");
  command->callback([arguments, &program] { program.action = [arguments] { return run(*arguments); }; });
}

}  // namespace app
