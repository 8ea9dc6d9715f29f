// skyshaft contact: frames of two recordings on one sheet, before above after.

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/cmd/commands.h"
#include "app/exit_status.h"
#include "app/process/output_files.h"
#include "app/report/contact_sheet.h"

namespace app {
namespace {

struct ContactArguments {
  std::string before;
  std::string after;
  std::string output;
  ContactSheetOptions options;
  bool overwrite = false;
};

}  // namespace

void add_contact_command(CLI::App& app, Program& program) {
  CLI::App* command = app.add_subcommand("contact", "Put frames of two recordings on one sheet, before above after");
  auto arguments = std::make_shared<ContactArguments>();
  command->add_option("BEFORE", arguments->before, "Video file, or pictures: 'shot_%04d.png', 'shots/*.jpg', a folder")
      ->required();
  command->add_option("AFTER", arguments->after, "The same, composited")->required();
  command->add_option("-o,--output", arguments->output, "The sheet, PNG")->required();
  command->add_option("--columns", arguments->options.columns, "Number of evenly spaced frames; default: 4")
      ->check(CLI::Range(1, 24));
  command->add_option("--width", arguments->options.cell_width, "Width of each picture, pixels; default: 640")
      ->check(CLI::Range(16, 4096));
  command->add_flag("--overwrite", arguments->overwrite, "Replace a file that exists");
  command->footer("Example:\n  skyshaft contact clip.mp4 composite.mp4 -o sheet.png --columns 6");
  command->callback([arguments, &program] {
    program.action = [arguments] {
      check_files({{"BEFORE", arguments->before}, {"AFTER", arguments->after}}, {{"-o", arguments->output}},
                  arguments->overwrite);
      write_contact_sheet(arguments->before, arguments->after, arguments->output, arguments->options);
      return static_cast<int>(kDone);
    };
  });
}

}  // namespace app
