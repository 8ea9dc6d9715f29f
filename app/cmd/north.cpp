// skyshaft north: which way a tag map faces, from a shadow in a photograph or from a compass.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "app/calibration/inputs.h"
#include "app/calibration/shadow_clicker.h"
#include "app/calibration/tag_map_text.h"
#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/exit_status.h"
#include "app/process/output_files.h"
#include "app/scene_file/sections.h"
#include "ar/error.h"
#include "ar/place/place.h"
#include "ar/track/lens.h"
#include "ar/track/tracker.h"
#include "calib/files/camera_file.h"
#include "calib/tagmap/heading.h"
#include "render/sun/sun.h"

namespace app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct NorthArguments {
  std::string map;
  std::string output;
  std::string photo;
  std::string camera;
  std::vector<double> base;
  std::vector<double> tip;
  double ground_m = 0.0;
  double click_px = 2.0;
  std::string at;
  std::string time;
  int tag = -1;
  double compass_deg = 0.0;
  bool has_compass = false;
  double declination_deg = 0.0;
  double compass_sigma_deg = 3.0;
  bool overwrite = false;
};

ar::TagMap read_map(const std::string& path) {
  return read_tag_map(YamlValue::load(path, "tag map"));
}

render::SunPosition sun_of(const NorthArguments& arguments) {
  try {
    const ar::GeoPosition at = ar::parse_position(arguments.at);
    const render::Place place{at.latitude_deg / kDegrees, at.longitude_deg / kDegrees, at.height_m};
    return render::sun_position(place, ar::parse_time(arguments.time));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

// Given, or clicked in a window; nothing when that was closed.
std::optional<ShadowPixels> shadow_pixels(const NorthArguments& arguments, const ar::Frame& photo) {
  if (arguments.base.size() == 2) {
    return ShadowPixels{{arguments.base[0], arguments.base[1]}, {arguments.tip[0], arguments.tip[1]}};
  }
  const auto clicked = click_shadow(photo, arguments.photo);
  if (clicked) {
    std::cout << fmt::format("clicked --base {:.1f},{:.1f} --tip {:.1f},{:.1f}\n", clicked->base.x, clicked->base.y,
                             clicked->tip.x, clicked->tip.y);
  }
  return clicked;
}

// Nothing when it was called off.
std::optional<calib::Heading> from_shadow(const NorthArguments& arguments, const ar::TagMap& map) {
  const auto source = open_quietly(arguments.photo);
  const auto frame = source->next();
  if (!frame) throw ar::InputError(arguments.photo + ": no picture in it\ngive a photograph");
  const ar::CameraModel camera =
      ar::scaled(calib::read_camera_file(arguments.camera), frame->format.width, frame->format.height);
  ar::DetectorOptions options;
  options.families = {map.family};
  ar::Detector detector(options);
  const auto pose = ar::estimate_pose(camera, map, detector.detect(*frame));
  if (!pose) {
    throw ar::InputError(
        fmt::format("{}: no tag of {} is seen in it\nthe photograph must show a tag of the map as well",
                    arguments.photo, arguments.map));
  }
  const render::SunPosition sun = sun_of(arguments);
  if (sun.apparent_elevation_rad * kDegrees < 2.0) {
    throw std::runtime_error(
        fmt::format("the sun stands at {:.1f} degrees there and then: no shadow to go by\ncheck --at and "
                    "--time (with its zone)",
                    sun.apparent_elevation_rad * kDegrees));
  }
  const auto pixels = shadow_pixels(arguments, *frame);
  if (!pixels) return std::nullopt;
  calib::ShadowClicks clicks;
  clicks.base_px = pixels->base;
  clicks.tip_px = pixels->tip;
  clicks.sigma_px = arguments.click_px;
  clicks.ground_m = arguments.ground_m;
  return calib::heading_from_shadow(ar::Lens(camera), pose->world_from_camera, pose->covariance, clicks,
                                    sun.azimuth_rad);
}

std::optional<calib::Heading> from_compass(const NorthArguments& arguments, const ar::TagMap& map) {
  const int id = arguments.tag >= 0 ? arguments.tag : map.tags.begin()->first;
  const auto tag = map.tags.find(id);
  if (tag == map.tags.end()) {
    throw UsageError(fmt::format("--tag: {} has no tag {}\ngive one of its tags", arguments.map, id));
  }
  const double truth = (arguments.compass_deg + arguments.declination_deg) / kDegrees;
  return calib::Heading{calib::wrapped(truth - calib::heading_of_tag(tag->second.world_from_tag)),
                        arguments.compass_sigma_deg / kDegrees};
}

void check_shadow_arguments(const NorthArguments& arguments) {
  if (arguments.camera.empty() || arguments.at.empty() || arguments.time.empty()) {
    throw UsageError("a shadow needs --camera, --at and --time\nsee: skyshaft north --help");
  }
  if (arguments.base.size() != arguments.tip.size()) {
    throw UsageError(
        "--base and --tip belong together\ngive X,Y of both in pixels, or neither to click them in a window");
  }
}

int run(const NorthArguments& arguments) {
  const bool shadow = !arguments.photo.empty();
  if (shadow == arguments.has_compass) {
    throw UsageError("one of --photo and --compass\n--photo with a shadow, or --compass of a tag");
  }
  if (shadow) check_shadow_arguments(arguments);
  check_files({{"MAP", arguments.map}, {"--photo", arguments.photo}, {"--camera", arguments.camera}},
              {{"-o", arguments.output}}, arguments.overwrite);
  ar::TagMap map = read_map(arguments.map);
  const auto found = shadow ? from_shadow(arguments, map) : from_compass(arguments, map);
  if (!found) return kInterrupted;
  const calib::Heading& heading = *found;
  const std::string what = fmt::format("turned by {:+.3f} +- {:.3f} degrees clockwise from above",
                                       heading.turn_rad * kDegrees, heading.sigma_rad * kDegrees);
  const ar::Rigid3 turn{ar::rotation_from_vector({0.0, 0.0, -heading.turn_rad}), {0.0, 0.0, 0.0}};
  for (auto& [id, tag] : map.tags) tag.world_from_tag = turn * tag.world_from_tag;
  if (!arguments.output.empty()) {
    write_whole(arguments.output, tag_map_text(map, "true north: " + what, [](int) { return ""; }),
                arguments.overwrite);
  }
  std::cout << fmt::format("the map is to be {} to face true north\n", what);
  for (const auto& [id, tag] : map.tags) {
    std::cout << fmt::format("tag {:4} heading {:8.3f} degrees ({})\n", id,
                             std::fmod(calib::heading_of_tag(tag.world_from_tag) * kDegrees + 360.0, 360.0),
                             calib::lies_flat(tag.world_from_tag) ? "of its top edge" : "that its face looks");
  }
  return kDone;
}

}  // namespace

void add_north_command(CLI::App& app, Program& program) {
  CLI::App* command =
      app.add_subcommand("north", "Which way a tag map faces: from a shadow in a photograph, or a compass");
  auto arguments = std::make_shared<NorthArguments>();
  command->add_option("MAP", arguments->map, "Tag map whose up is right and whose north is not yet")->required();
  command->add_option("-o,--output", arguments->output, "Tag map to write, turned to true north");
  command->add_option("--photo", arguments->photo,
                      "Photograph of a vertical edge, its shadow on level ground and a tag of the map");
  command->add_option("--camera", arguments->camera, "Camera file of the photograph");
  command
      ->add_option("--base", arguments->base,
                   "X,Y: pixel where the edge meets the ground; without it, both pixels are clicked in a window")
      ->delimiter(',')
      ->expected(2);
  command->add_option("--tip", arguments->tip, "X,Y: pixel of a point of the edge's shadow, the farther the better")
      ->delimiter(',')
      ->expected(2);
  command->add_option("--click-sigma", arguments->click_px, "How well those pixels are known, px")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--ground", arguments->ground_m, "Height of the ground in the map, m")->capture_default_str();
  command->add_option("--at", arguments->at, "LATITUDE,LONGITUDE[,HEIGHT]");
  command->add_option("--time", arguments->time, "When it was taken: 2024-06-21T07:30:00Z");
  CLI::Option* compass =
      command->add_option("--compass", arguments->compass_deg,
                          "Compass reading of a tag: where its top edge points if it lies, its face looks if it hangs");
  command->add_option("--declination", arguments->declination_deg, "Of the compass there, degrees, east positive")
      ->needs(compass);
  command->add_option("--compass-sigma", arguments->compass_sigma_deg, "How well the compass is read, degrees")
      ->needs(compass)
      ->capture_default_str();
  command->add_option("--tag", arguments->tag, "The tag of the compass reading; default: the first")->needs(compass);
  command->add_flag("--overwrite", arguments->overwrite, "Replace a file that exists");
  command->footer(
      "Without --base and --tip a window shows the photograph: click the foot of the edge, then a point of its "
      "shadow;\n"
      "Backspace takes a click back, Enter accepts. The status is 130 when the window is closed.\n\n"
      "Examples:\n  skyshaft north tags.yaml --photo post.jpg --camera phone.yaml --base 812,1430 --tip 1403,1288 \\\n"
      "      --at 48.8584,2.2945 --time 2024-06-21T07:30:00Z -o tags_north.yaml\n"
      "  skyshaft north tags.yaml --tag 0 --compass 197 --declination 1.8 -o tags_north.yaml");
  command->callback([arguments, compass, &program] {
    arguments->has_compass = compass->count() > 0;
    program.action = [arguments] { return run(*arguments); };
  });
}

}  // namespace app
