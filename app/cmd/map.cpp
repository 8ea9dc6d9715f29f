// skyshaft map: where the tags of a place are, from a recording that sees them.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "app/calibration/board_words.h"
#include "app/calibration/inputs.h"
#include "app/calibration/tag_map_text.h"
#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/exit_status.h"
#include "app/pipeline/interrupt.h"
#include "app/pipeline/progress.h"
#include "app/process/output_files.h"
#include "ar/capture/source.h"
#include "ar/error.h"
#include "ar/track/camera.h"
#include "calib/files/camera_file.h"
#include "calib/tagmap/tag_mapper.h"
#include "render/base/number.h"

namespace app {
namespace {

constexpr int kLargestTagId = 99999;

struct MapArguments {
  std::vector<std::string> inputs;
  std::string camera;
  std::string output;
  std::string family = "tag36h11";
  std::string size;
  std::vector<std::string> own_sizes;
  int origin = -1;
  bool wall = false;
  bool flat = false;
  double heading_deg = 0.0;
  std::vector<double> position{0.0, 0.0, 0.0};
  bool overwrite = false;
};

calib::MapperOptions mapper_options(const MapArguments& arguments) {
  calib::MapperOptions options;
  options.tag_size_m = metres_from(arguments.size);
  for (const std::string& own : arguments.own_sizes) {
    const std::size_t colon = own.find(':');
    const auto id = render::parse_count<int>(own.substr(0, colon));
    if (colon == std::string::npos || !id || *id > kLargestTagId) {
      throw UsageError(fmt::format("--tag-size: '{}' is no ID:SIZE\nexample: --tag-size 7:250mm", own));
    }
    options.own_sizes_m[*id] = metres_from(own.substr(colon + 1));
  }
  if (arguments.origin >= 0) options.origin = arguments.origin;
  return options;
}

// What every picture shows, and the camera for their size.
std::vector<calib::TagPicture> look_at(const MapArguments& arguments, bool quiet, ar::CameraModel& camera) {
  ar::DetectorOptions options;
  options.families = {arguments.family};
  options.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  ar::Detector detector(options);
  const ar::CameraModel as_calibrated = calib::read_camera_file(arguments.camera);
  Progress progress(std::nullopt, quiet);
  std::vector<calib::TagPicture> pictures;
  for (const std::string& input : one_by_one(arguments.inputs)) {
    const auto source = open_quietly(input);
    const auto scaled = ar::scaled(as_calibrated, source->info().format.width, source->info().format.height);
    if (!pictures.empty() && scaled.width != camera.width) {
      throw ar::InputError(fmt::format("{}: {} px across, the pictures before it {}\ngive pictures of one size", input,
                                       scaled.width, camera.width));
    }
    camera = scaled;
    const int every = source->info().path.empty() ? 1 : frames_to_skip(source->info());
    std::int64_t index = 0;
    while (const auto frame = source->next()) {
      if (InterruptGuard::requested()) break;
      if (index++ % every != 0) continue;
      pictures.push_back({input, detector.detect(*frame)});
      progress.update(static_cast<std::int64_t>(pictures.size()));
    }
  }
  return pictures;
}

// The map with its origin's tag where the user says that it is.
ar::TagMap placed(const MapArguments& arguments, const calib::MapResult& result) {
  const cv::Vec3d position(arguments.position[0], arguments.position[1], arguments.position[2]);
  const double heading = arguments.heading_deg * std::numbers::pi / 180.0;
  const ar::Rigid3 world_from_map = arguments.wall ? ar::wall_tag(position, heading) : ar::flat_tag(position, heading);
  ar::TagMap map = result.map;
  for (auto& [id, tag] : map.tags) tag.world_from_tag = world_from_map * tag.world_from_tag;
  return map;
}

std::string sigma_text(const calib::MappedTagNote& note) {
  return fmt::format("+- {:.1f} mm, {:.2f} deg, {} pictures, {:.2f} px", 1e3 * note.sigma_position_m,
                     note.sigma_turn_rad * 180.0 / std::numbers::pi, note.pictures, note.rms_px);
}

std::string map_text(const MapArguments& arguments, const calib::MapResult& result) {
  const std::string heading = fmt::format(
      "{} tags in one group, RMS {:.3f} px over {} pictures; after each tag its standard deviation relative to tag {}",
      result.map.tags.size(), result.rms_px, result.pictures_used, result.origin);
  return tag_map_text(placed(arguments, result), heading, [&](int id) {
    return id == result.origin ? std::string("origin") : sigma_text(result.notes.at(id));
  });
}

void print(const MapArguments& arguments, const calib::MapResult& result) {
  std::cout << fmt::format(
      "{} tags in one group with tag {}, from {} pictures; reprojection RMS {:.3f} px over {} "
      "corners, worst tag in a picture {:.2f} px; {} tags in pictures left out\n",
      result.map.tags.size(), result.origin, result.pictures_used, result.rms_px, result.corners_used, result.worst_px,
      result.observations_rejected);
  std::cout << "tag   east m  north m     up m   standard deviation, pictures, RMS\n";
  for (const auto& [id, tag] : placed(arguments, result).tags) {
    const cv::Vec3d& p = tag.world_from_tag.translation;
    std::cout << fmt::format("{:4} {:8.4f} {:8.4f} {:8.4f}   {}\n", id, p[0], p[1], p[2],
                             id == result.origin ? "origin" : sigma_text(result.notes.at(id)));
  }
}

int run(const MapArguments& arguments, bool quiet) {
  if (arguments.wall && arguments.flat) throw UsageError("--flat and --wall\nthe origin's tag either lies or hangs");
  const calib::MapperOptions options = mapper_options(arguments);
  std::vector<NamedPath> inputs{{"--camera", arguments.camera}};
  for (const std::string& input : arguments.inputs) inputs.push_back({"input", input});
  check_files(inputs, {{"-o", arguments.output}}, arguments.overwrite);
  ar::CameraModel camera;
  const InterruptGuard interrupt;
  const auto pictures = look_at(arguments, quiet, camera);
  if (InterruptGuard::requested()) return kInterrupted;
  const calib::MapResult result = calib::map_tags(camera, arguments.family, pictures, options);
  if (!arguments.wall && !arguments.flat) {
    spdlog::warn(
        "how tag {} is mounted was not given: taken to lie flat, its top edge heading {:g} degrees; give --flat "
        "or --wall, and --heading",
        result.origin, arguments.heading_deg);
  }
  for (const std::vector<int>& group : result.other_groups) {
    spdlog::warn("no picture connects tag{} {} with tag {}: not in the map; film both groups together once",
                 group.size() > 1 ? "s" : "", fmt::join(group, ", "), result.origin);
  }
  write_whole(arguments.output, map_text(arguments, result), arguments.overwrite);
  print(arguments, result);
  return kDone;
}

}  // namespace

void add_map_command(CLI::App& app, Program& program) {
  CLI::App* command = app.add_subcommand("map", "Where tags of unknown places are, from a recording that sees them");
  auto arguments = std::make_shared<MapArguments>();
  command->add_option("input", arguments->inputs, "Recordings, pictures, folders of pictures")->required();
  command->add_option("--camera", arguments->camera, "Camera file")->required();
  command->add_option("--size", arguments->size, "Size of the tags: 0.16, 160mm; outer edge of the black border")
      ->required();
  command->add_option("--tag-size", arguments->own_sizes, "ID:SIZE of a tag of another size");
  command->add_option("--family", arguments->family, "Tag family")
      ->check(CLI::IsMember(ar::tag_families()))
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "Tag map to write")->required();
  command->add_option("--origin", arguments->origin, "Tag that fixes the map; default: the one seen most often")
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--flat", arguments->flat, "The origin's tag lies face up; --heading: where its top edge points");
  command->add_flag("--wall", arguments->wall, "The origin's tag hangs upright; --heading: where its face looks");
  command->add_option("--heading", arguments->heading_deg, "Degrees clockwise from north")
      ->check(CLI::Range(-360.0, 360.0));
  command->add_option("--position", arguments->position, "Of the origin's tag: EAST,NORTH,UP in m")
      ->delimiter(',')
      ->expected(3);
  command->add_flag("--overwrite", arguments->overwrite, "Replace a file that exists");
  command->footer(
      "The map is a scene's tags at once:  tags: { file: tags.yaml }\n"
      "Tags that no picture connects with the origin's are named and left out.\n\n"
      "Example:\n  skyshaft map walk.mp4 --camera phone.yaml --size 127mm --origin 0 --wall --heading 200 -o "
      "tags.yaml");
  command->callback(
      [arguments, &program] { program.action = [arguments, &program] { return run(*arguments, program.quiet); }; });
}

}  // namespace app
