// skyshaft detect: the tags in pictures and videos, and the pose of each when camera and size are known.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/process/output_files.h"
#include "app/tables/detection_table.h"
#include "ar/capture/file/open_source.h"
#include "calib/files/camera_file.h"

namespace app {
namespace {

struct DetectArguments {
  std::vector<std::string> inputs;
  std::string camera_file;
  double fov_deg = 0.0;
  double size_m = 0.0;
  ar::DetectorOptions detector;
  std::string format = "csv";
  std::string output;
  bool overwrite = false;
};

// The camera for pictures of that size, or nothing where none was given.
std::optional<ar::CameraModel> camera_for(const DetectArguments& arguments, const ar::SourceInfo& source) {
  const int width = source.format.width;
  const int height = source.format.height;
  if (!arguments.camera_file.empty()) return ar::scaled(calib::read_camera_file(arguments.camera_file), width, height);
  if (arguments.fov_deg == 0.0) return std::nullopt;
  const double aspect = static_cast<double>(source.sample_aspect.num) / source.sample_aspect.den;
  return ar::camera_from_horizontal_fov(width, height, arguments.fov_deg * std::numbers::pi / 180.0, aspect);
}

void detect_in(const std::string& input, const DetectArguments& arguments, ar::Detector& detector,
               DetectionTable& table) {
  const auto source = ar::open_source(input);
  const std::optional<ar::CameraModel> camera = camera_for(arguments, source->info());
  while (const std::optional<ar::Frame> frame = source->next()) {
    for (const ar::Detection& detection : detector.detect(*frame)) {
      table.add(input, *frame, detection, camera ? tag_pose(*camera, detection, arguments.size_m) : std::nullopt);
    }
  }
}

void check(const DetectArguments& arguments) {
  const bool camera = !arguments.camera_file.empty() || arguments.fov_deg > 0.0;
  if (camera != (arguments.size_m > 0.0)) {
    throw UsageError("a pose needs both the camera and the tag's size\ngive --camera or --fov, and --size, or neither");
  }
  std::vector<NamedPath> inputs{{"--camera", arguments.camera_file}};
  for (const std::string& input : arguments.inputs) inputs.push_back({"input", input});
  check_files(inputs, {{"-o", arguments.output}}, arguments.overwrite);
}

int run(const DetectArguments& arguments) {
  check(arguments);
  ar::Detector detector(arguments.detector);
  DetectionTable table(arguments.size_m > 0.0);
  for (const std::string& input : arguments.inputs) detect_in(input, arguments, detector, table);
  const auto write = [&](std::ostream& out) {
    arguments.format == "json" ? table.write_json(out) : table.write_csv(out);
  };
  if (arguments.output.empty()) {
    write(std::cout);
    return 0;
  }
  std::ostringstream text;
  write(text);
  write_whole(arguments.output, text.str(), arguments.overwrite);
  return 0;
}

// Accepts what the detector can shrink a picture by.
CLI::Validator known_decimation() {
  const auto complaint = [](const std::string& text) {
    double factor = 0.0;
    const bool known = CLI::detail::lexical_cast(text, factor) && ar::is_known_decimation(factor) && factor <= 16.0;
    return known ? std::string() : fmt::format("found '{}'; accepted: 1, 1.5, or a whole number from 2 to 16", text);
  };
  return {complaint, "1, 1.5, 2, 3 ... 16"};
}

void add_detector_options(CLI::App& detect, DetectArguments& arguments) {
  detect.add_option("--family", arguments.detector.families, "Tag families, separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember(ar::tag_families()))
      ->capture_default_str();
  detect.add_option("--decimate", arguments.detector.quad_decimate, "Seek tags in a picture that much smaller: faster")
      ->check(known_decimation())
      ->capture_default_str();
  detect.add_option("--max-hamming", arguments.detector.max_hamming, "Wrong bits to correct")
      ->check(CLI::Range(0, 2))
      ->capture_default_str();
  detect.add_option("--min-margin", arguments.detector.min_margin, "Smallest decision margin that counts")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  detect.add_option("--threads", arguments.detector.threads, "Threads of the detector")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
}

}  // namespace

void add_detect_command(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<DetectArguments>();
  CLI::App& detect = *app.add_subcommand("detect", "Find the tags in pictures and videos, and their poses");
  detect.add_option("input", arguments->inputs, "Videos, pictures, patterns (shot_%04d.png) or folders of pictures")
      ->required();
  CLI::Option* camera =
      detect.add_option("--camera", arguments->camera_file,
                        "Camera file (OpenCV, ROS camera_info, Kalibr camchain): adds each tag's pose");
  detect.add_option("--fov", arguments->fov_deg, "Horizontal field of view in degrees, where there is no camera file")
      ->check(CLI::Range(1.0, 179.0))
      ->excludes(camera);
  detect
      .add_option("--size", arguments->size_m,
                  "Tag size in m: outer edge of the black border (white: inverted families)")
      ->check(CLI::PositiveNumber);
  add_detector_options(detect, *arguments);
  detect.add_option("--format", arguments->format, "csv or json")
      ->check(CLI::IsMember({"csv", "json"}))
      ->capture_default_str();
  detect.add_option("-o,--output", arguments->output, "File to write instead of standard output");
  detect.add_flag("--overwrite", arguments->overwrite, "Replace the output file if it exists");
  detect.footer(
      "One row a detection. Corners c0 ... c3 are left-bottom, right-bottom, right-top, left-top of the tag, in "
      "pixels\n"
      "whose first has its centre at 0,0 (OpenCV's count). The pose is camera_from_tag: position in m and quaternion, "
      "in\n"
      "the camera's axes x right, y down, z forward; the tag's are x right, y down, z into the tag. rms_px is how far "
      "its\n"
      "corners fall from the detected ones; second_rms_px the same for the other pose that a square allows, empty\n"
      "(JSON: null) where there is none.\n\n"
      "Example:\n  skyshaft detect photo.jpg --camera camera.yaml --size 0.16 --format json");
  detect.callback([&program, arguments] { program.action = [arguments] { return run(*arguments); }; });
}

}  // namespace app
