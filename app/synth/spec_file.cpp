// The spec file of `skyshaft synth`; docs/synth.md describes it for users.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/scene_file/sections.h"
#include "app/scene_file/yaml_value.h"
#include "app/synth/plants.h"
#include "app/synth/spec.h"
#include "app/synth/surfaces.h"
#include "ar/place/place.h"
#include "calib/files/camera_file.h"

namespace app::synth {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

std::function<bool(double)> within(double low, double high) {
  return [=](double x) { return x >= low && x <= high; };
}

double number_or(const YamlMap& map, const std::string& key, double otherwise, double low, double high,
                 const std::string& unit) {
  return map.number_or(key, otherwise, fmt::format("{} from {} to {}", unit, low, high), within(low, high));
}

int integer_or(const YamlMap& map, const std::string& key, int otherwise, int low, int high) {
  const auto value = map.find(key);
  return value ? value->integer(low, high) : otherwise;
}

void read_size(const YamlValue& value, Spec& spec) {
  const auto items = value.list();
  if (items.size() != 2) value.fail("[width, height] in pixels");
  spec.width = items[0].integer(16, 8192);
  spec.height = items[1].integer(16, 8192);
  if (spec.width % 2 != 0 || spec.height % 2 != 0) value.fail("even numbers of pixels: colour has half the resolution");
}

void read_rate(const YamlValue& value, Spec& spec) {
  const double fps = value.number("frames a second, 1 to 240", within(1.0, 240.0));
  if (std::abs(fps - std::round(fps)) < 1e-9) {
    spec.fps_num = static_cast<int>(std::lround(fps));
    spec.fps_den = 1;
  } else {  // 29.97 and its kind are 30000/1001
    spec.fps_num = static_cast<int>(std::lround(std::ceil(fps) * 1000.0));
    spec.fps_den = static_cast<int>(std::lround(spec.fps_num / fps));
  }
}

void read_place(const YamlValue& value, Spec& spec) {
  const YamlMap map = value.map({"latitude", "longitude", "height"});
  spec.latitude_deg =
      map.require("latitude", "degrees, north positive").number("degrees from -90 to 90", within(-90, 90));
  spec.longitude_deg =
      map.require("longitude", "degrees, east positive").number("degrees from -180 to 180", within(-180, 180));
  spec.height_m = number_or(map, "height", 0.0, -500.0, 9000.0, "metres");
}

void read_time(const YamlValue& value, Spec& spec) {
  const std::string text = value.text("a time as 2024-06-21T07:30:00Z");
  try {
    spec.time = ar::parse_time(text);
  } catch (const std::invalid_argument&) {
    value.fail("a time as 2024-06-21T07:30:00Z");
  }
}

void read_sky_of(const YamlValue& value, Spec& spec) {
  const YamlMap map = value.map({"model", "turbidity", "clouds"});
  if (const auto model = map.find("model")) spec.sky_model = model->text("perez or preetham");
  spec.turbidity = number_or(map, "turbidity", 3.0, 1.0, 20.0, "a number");
  spec.clouds = number_or(map, "clouds", 0.0, 0.0, 1.0, "a share");
}

std::vector<double> read_numbers(const YamlValue& value) {
  std::vector<double> numbers;
  for (const YamlValue& item : value.list()) numbers.push_back(item.number("a number", [](double) { return true; }));
  return numbers;
}

void read_lens(const YamlMap& map, ar::CameraModel& camera) {
  const auto model = map.find("model");
  if (!model) return;
  const std::string name = model->one_of({"none", "plumb-bob", "rational", "fisheye"});
  if (name == "none") return;
  const YamlValue value = map.require("distortion", "a list of the lens model's coefficients, OpenCV's order");
  camera.distortion = read_numbers(value);
  const std::size_t n = camera.distortion.size();
  if (name == "plumb-bob") {
    camera.lens = ar::LensModel::PlumbBob;
    if (n != 4 && n != 5) value.fail("4 or 5 coefficients: k1, k2, p1, p2, k3");
  } else if (name == "rational") {
    camera.lens = ar::LensModel::Rational;
    if (n != 8) value.fail("8 coefficients: k1, k2, p1, p2, k3, k4, k5, k6");
  } else {
    camera.lens = ar::LensModel::Fisheye;
    if (n != 4) value.fail("4 coefficients: k1, k2, k3, k4");
  }
}

void read_camera(const YamlValue& value, Spec& spec) {
  const YamlMap map = value.map({"file", "fov_deg", "fx", "fy", "cx", "cy", "model", "distortion"});
  const std::string way = map.exactly_one_of({"file", "fov_deg", "fx"});
  if (way == "file") {
    for (const char* other : {"fy", "cx", "cy", "model", "distortion"})
      if (const auto extra = map.find(other)) extra->fail_found("both file and " + std::string(other), "file alone");
    const YamlValue file = *map.find("file");
    spec.camera =
        ar::scaled(calib::read_camera_file(file.resolve(file.text("a camera file"))), spec.width, spec.height);
    return;
  }
  if (way == "fov_deg") {
    const double fov = map.find("fov_deg")->number("degrees from 5 to 150, across the picture", within(5.0, 150.0));
    spec.camera = ar::camera_from_horizontal_fov(spec.width, spec.height, fov * kRadiansPerDegree);
  } else {
    const double fx = map.find("fx")->number("pixels above 0", [](double x) { return x > 0.0; });
    const double fy = number_or(map, "fy", fx, 1.0, 1e5, "pixels");
    const double cx = number_or(map, "cx", 0.5 * spec.width - 0.5, -1e5, 1e5, "pixels");
    const double cy = number_or(map, "cy", 0.5 * spec.height - 0.5, -1e5, 1e5, "pixels");
    spec.camera.width = spec.width;
    spec.camera.height = spec.height;
    spec.camera.intrinsics = {fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0};
  }
  read_lens(map, spec.camera);
  spec.camera.origin = spec.file.string();
}

Orbit read_orbit(const YamlValue& value) {
  const YamlMap map = value.map({"center", "radius", "height", "from_deg", "to_deg"});
  Orbit orbit;
  orbit.center = read_position(map.require("center", "[east, north, up] in metres"));
  orbit.radius_m = number_or(map, "radius", 3.0, 0.01, 1000.0, "metres");
  orbit.height_m = number_or(map, "height", 1.6, 0.01, 1000.0, "metres");
  orbit.from_rad = read_heading_rad(map.require("from_deg", "heading from the centre to the first camera position"));
  orbit.to_rad = read_heading_rad(map.require("to_deg", "heading from the centre to the last camera position"));
  return orbit;
}

void read_path(const YamlValue& value, PathSpec& path) {
  const YamlMap map = value.map({"keyframes", "orbit", "sway"});
  if (map.exactly_one_of({"keyframes", "orbit"}) == "orbit") {
    path.orbit = read_orbit(*map.find("orbit"));
  } else {
    const YamlValue list = *map.find("keyframes");
    for (const YamlValue& item : list.list()) {
      const YamlMap key = item.map({"time", "position", "target"});
      PathKey k;
      k.time_s = number_or(key, "time", 0.0, -1e4, 1e6, "seconds");
      k.position = read_position(key.require("position", "[east, north, up] in metres"));
      k.target = read_position(key.require("target", "[east, north, up] in metres"));
      if (!path.keys.empty() && k.time_s <= path.keys.back().time_s)
        item.fail_found(fmt::format("time {} not after the one before", k.time_s), "keyframes in order of time");
      if (k.position == k.target) item.fail_found("position and target alike", "a target away from the position");
      path.keys.push_back(k);
    }
    if (path.keys.empty()) list.fail_found("an empty list", "at least one keyframe");
  }
  if (const auto sway = map.find("sway")) {
    const YamlMap amounts = sway->map({"metres", "degrees"});
    path.sway_m = number_or(amounts, "metres", 0.0, 0.0, 1.0, "metres");
    path.sway_rad = number_or(amounts, "degrees", 0.0, 0.0, 10.0, "degrees") * kRadiansPerDegree;
  }
}

void read_ground(const YamlValue& value, GroundSpec& ground) {
  const YamlMap map = value.map({"surface", "around", "extent"});
  if (const auto surface = map.find("surface")) ground.surface = surface->one_of(ground_surfaces());
  if (const auto around = map.find("around")) ground.around = around->one_of(ground_surfaces());
  if (const auto extent = map.find("extent")) {
    const auto sides = read_numbers(*extent);
    if (sides.size() != 4 || sides[0] >= sides[2] || sides[1] >= sides[3])
      extent->fail("[west, south, east, north] in metres, west < east, south < north");
    std::copy(sides.begin(), sides.end(), ground.extent.begin());
  }
}

BoxSpec read_box(const YamlValue& value) {
  const YamlMap map = value.map({"size", "position", "heading_deg", "surface"});
  BoxSpec box;
  const YamlValue size = map.require("size", "[width, depth, height] in metres");
  box.size = size.vector3("three lengths above 0");
  if (box.size.x <= 0.0 || box.size.y <= 0.0 || box.size.z <= 0.0) size.fail("three lengths above 0");
  box.position = read_position(map.require("position", "[east, north, up] of its middle, metres"));
  if (const auto heading = map.find("heading_deg")) box.heading_rad = read_heading_rad(*heading);
  if (const auto surface = map.find("surface")) box.surface = surface->one_of(box_surfaces());
  return box;
}

PlantSpec read_plant(const YamlValue& value) {
  const YamlMap map = value.map({"kind", "position", "height", "width"});
  PlantSpec plant;
  plant.kind = map.require("kind", "what grows there").one_of(plant_kinds());
  plant.position = read_position(map.require("position", "[east, north, up] where it leaves the ground, metres"));
  plant.height_m = number_or(map, "height", 3.0, 0.05, 40.0, "metres");
  plant.width_m = number_or(map, "width", 2.0, 0.05, 40.0, "metres");
  return plant;
}

void read_picture(const YamlMap& map, Spec& spec) {
  if (const auto size = map.find("size")) read_size(*size, spec);
  if (const auto fps = map.find("fps")) read_rate(*fps, spec);
  spec.frames = integer_or(map, "frames", spec.frames, 1, 1000000);
  if (const auto depth = map.find("bit_depth")) {
    spec.bit_depth = depth->integer(8, 10);
    if (spec.bit_depth == 9) depth->fail("8 or 10");
  }
  spec.shutter_s = number_or(map, "shutter_s", spec.shutter_s, 0.0, 1.0, "seconds");
  spec.noise_codes = number_or(map, "noise", 0.0, 0.0, 50.0, "8-bit codes");
  spec.blur_px = number_or(map, "blur_px", 0.0, 0.0, 5.0, "pixels");
  spec.seed = static_cast<std::uint32_t>(integer_or(map, "seed", 1, 0, 1000000000));
  if (const auto samples = map.find("samples")) {
    spec.samples = samples->integer(4, 256);
    const auto side = static_cast<int>(std::lround(std::sqrt(spec.samples)));
    if (side * side != spec.samples || side % 7 == 0)
      samples->fail("4, 9, 16, 25, 36, 64, 81, 100, 121, 144, 169 or 256");
  }
  if (map.find("exposure")) spec.exposure = read_exposure(*map.find("exposure"));
}

}  // namespace

Spec read_spec(const std::filesystem::path& file) {
  const YamlValue root = YamlValue::load(file, "synth spec");
  const YamlMap map =
      root.map({"skyshaft_synth", "size",      "fps",   "frames",  "bit_depth", "place", "time",   "sky",
                "exposure",       "shutter_s", "noise", "blur_px", "samples",   "seed",  "camera", "path",
                "tags",           "ground",    "boxes", "plants",  "horizon"});
  map.require("skyshaft_synth", "1, the version of this format").integer(1, 1);
  Spec spec;
  spec.file = file;
  read_picture(map, spec);
  read_place(map.require("place", "{ latitude, longitude }"), spec);
  read_time(map.require("time", "a time as 2024-06-21T07:30:00Z"), spec);
  if (const auto sky = map.find("sky")) read_sky_of(*sky, spec);
  read_camera(map.require("camera", "{ fov_deg: 60 } or { fx, fy, cx, cy } or { file }"), spec);
  read_path(map.require("path", "keyframes or an orbit"), spec.path);
  if (const auto tags = map.find("tags")) spec.tags = read_tags(*tags);
  if (const auto ground = map.find("ground")) read_ground(*ground, spec.ground);
  if (const auto boxes = map.find("boxes"))
    for (const YamlValue& box : boxes->list()) spec.boxes.push_back(read_box(box));
  if (const auto plants = map.find("plants"))
    for (const YamlValue& plant : plants->list()) spec.plants.push_back(read_plant(plant));
  if (const auto horizon = map.find("horizon")) spec.horizon = horizon->boolean();
  return spec;
}

}  // namespace app::synth
