// OpenCV YAML, ROS camera_info and Kalibr camchain as RawCamera, each message with its line.

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <initializer_list>
#include <set>

#include "ar/error.h"
#include "calib/files/raw_camera.h"

namespace calib {
namespace {

std::string place(const std::filesystem::path& path, const YAML::Mark& mark) {
  return fmt::format("{}:{}", path.string(), mark.line + 1);
}

std::string shown(const YAML::Node& node) {
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  if (node.IsSequence()) return fmt::format("a list of {}", node.size());
  if (node.IsMap()) return "a map";
  return "nothing";
}

// One map of the file. Looks keys up under any of the names that the formats give them.
class Section {
 public:
  Section(const YAML::Node& node, std::filesystem::path path) : node_(node), path_(std::move(path)) {
    std::set<std::string> seen;  // yaml-cpp 0.7 keeps the first of two equal keys and says nothing
    for (const auto& entry : node_) {
      if (!entry.first.IsScalar()) refuse(place(path_, entry.first.Mark()), "key", shown(entry.first), "a name");
      if (!seen.insert(entry.first.Scalar()).second) {
        refuse(place(path_, entry.first.Mark()), entry.first.Scalar(), "the key a second time", "each key once");
      }
    }
  }

  std::string where(const YAML::Node& node) const { return place(path_, node.Mark()); }

  YAML::Node find(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      const YAML::Node value = node_[name];
      if (value) return value;
    }
    return YAML::Node(YAML::NodeType::Undefined);
  }

  YAML::Node require(std::initializer_list<const char*> names, const std::string& accepted) const {
    YAML::Node value = find(names);
    if (!value.IsDefined()) refuse(where(node_), *names.begin(), "no such key", accepted);
    return value;
  }

  int positive(const YAML::Node& node, const char* key) const {
    int value = 0;
    if (!node.IsScalar() || !YAML::convert<int>::decode(node, value) || value <= 0 || value > 100000) {
      refuse(where(node), key, shown(node), "a number of px from 1 to 100000");
    }
    return value;
  }

  std::vector<double> numbers(const YAML::Node& node, const char* key) const {
    if (!node.IsSequence()) refuse(where(node), key, shown(node), "a list of numbers");
    std::vector<double> values;
    for (const YAML::Node& item : node) {
      double value = 0.0;
      if (!item.IsScalar() || !YAML::convert<double>::decode(item, value) || !std::isfinite(value)) {
        refuse(where(item), key, shown(item), "a finite number");
      }
      values.push_back(value);
    }
    return values;
  }

  // A list, or the map with rows, cols and data in which OpenCV and camera_calibration_parsers put a matrix.
  std::vector<double> matrix(const YAML::Node& node, const char* key) const {
    if (!node.IsMap()) return numbers(node, key);
    const Section map(node, path_);
    const YAML::Node data = map.require({"data"}, "rows, cols and data");
    const std::vector<double> values = numbers(data, key);
    const auto count = [&](const char* side) { return map.positive(map.require({side}, "rows, cols and data"), side); };
    const int expected = values.empty() ? 0 : count("rows") * count("cols");
    if (static_cast<std::size_t>(expected) != values.size()) {
      refuse(where(data), key, fmt::format("{} numbers", values.size()), fmt::format("rows x cols = {}", expected));
    }
    return values;
  }

 private:
  YAML::Node node_;
  std::filesystem::path path_;
};

RawCamera read_kalibr(const YAML::Node& node, const std::filesystem::path& path) {
  const Section camera(node, path);
  RawCamera raw;
  const YAML::Node projection = camera.require({"camera_model"}, "pinhole");
  if (!projection.IsScalar() || projection.Scalar() != "pinhole") {
    refuse(camera.where(projection), "camera_model", shown(projection), "pinhole");
  }
  const YAML::Node size = camera.require({"resolution"}, "[width, height]");
  if (!size.IsSequence() || size.size() != 2) refuse(camera.where(size), "resolution", shown(size), "[width, height]");
  raw.width = camera.positive(size[0], "resolution");
  raw.height = camera.positive(size[1], "resolution");

  const YAML::Node intrinsics = camera.require({"intrinsics"}, "[fx, fy, cx, cy]");
  const std::vector<double> k = camera.numbers(intrinsics, "intrinsics");
  raw.intrinsics_where = camera.where(intrinsics);
  if (k.size() != 4) {
    refuse(raw.intrinsics_where, "intrinsics", fmt::format("{} numbers", k.size()), "[fx, fy, cx, cy]");
  }
  raw.intrinsics = {k[0], 0.0, k[2], 0.0, k[1], k[3], 0.0, 0.0, 1.0};

  const YAML::Node model = camera.require({"distortion_model"}, "radtan, equidistant or none");
  raw.model_where = camera.where(model);
  raw.model = model.IsScalar() ? model.Scalar() : "";
  const YAML::Node distortion = camera.find({"distortion_coeffs"});
  if (distortion.IsDefined()) {
    raw.distortion = camera.numbers(distortion, "distortion_coeffs");
    raw.distortion_where = camera.where(distortion);
  } else if (raw.model != "none") {
    refuse(camera.where(node), "distortion_coeffs", "no such key", "four numbers");
  }
  return raw;
}

// OpenCV's own samples mark a fisheye with a flag instead of a model's name.
void read_fisheye_flag(const Section& camera, RawCamera& raw) {
  const YAML::Node flag = camera.find({"fisheye_model", "fisheyeModel"});
  if (!flag.IsDefined()) return;
  int on = 0;
  if (!flag.IsScalar() || !YAML::convert<int>::decode(flag, on)) {
    refuse(camera.where(flag), "fisheye_model", shown(flag), "0 or 1");
  }
  if (on != 0) raw.model = "fisheye";
  raw.model_where = camera.where(flag);
}

RawCamera read_matrices(const YAML::Node& node, const std::filesystem::path& path) {
  const Section camera(node, path);
  RawCamera raw;
  raw.width =
      camera.positive(camera.require({"image_width", "width"}, "the calibrated picture's width in px"), "image_width");
  raw.height = camera.positive(camera.require({"image_height", "height"}, "the calibrated picture's height in px"),
                               "image_height");
  const YAML::Node intrinsics = camera.require({"camera_matrix", "K", "k", "cameraMatrix", "Camera_Matrix"},
                                               "an OpenCV camera_matrix, a ROS K or a Kalibr cam0");
  raw.intrinsics = camera.matrix(intrinsics, "camera_matrix");
  raw.intrinsics_where = camera.where(intrinsics);
  const YAML::Node distortion =
      camera.find({"distortion_coefficients", "D", "d", "distCoeffs", "dist_coeffs", "Distortion_Coefficients"});
  raw.distortion_where = raw.intrinsics_where;
  if (distortion.IsDefined()) {
    raw.distortion = camera.matrix(distortion, "distortion_coefficients");
    raw.distortion_where = camera.where(distortion);
  }
  const YAML::Node model = camera.find({"distortion_model"});
  if (model.IsDefined()) {
    raw.model_where = camera.where(model);
    if (!model.IsScalar()) refuse(raw.model_where, "distortion_model", shown(model), "a model's name");
    raw.model = model.Scalar();
  } else {
    read_fisheye_flag(camera, raw);
  }
  return raw;
}

// OpenCV writes "%YAML:1.0", which YAML does not know. A comment in its place keeps the lines' numbers.
std::string without_opencv_header(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.starts_with("%YAML:")) text[0] = '#';
  return text;
}

}  // namespace

namespace {

YAML::Node load(const std::filesystem::path& path, const std::string& text) {
  YAML::Node root;
  try {
    root = YAML::Load(without_opencv_header(text));
  } catch (const YAML::Exception& error) {
    throw ar::InputError(fmt::format("{}: no YAML: {}\ngive an OpenCV, ROS camera_info or Kalibr camchain file",
                                     place(path, error.mark), error.msg));
  }
  if (!root.IsMap()) {
    throw ar::InputError(
        fmt::format("{}:1: found no keys but {}\ngive an OpenCV, ROS camera_info or Kalibr camchain file",
                    path.string(), shown(root)));
  }
  return root;
}

}  // namespace

std::optional<CameraNote> read_note(const std::filesystem::path& path, const std::string& text) {
  const YAML::Node root = load(path, text);
  const YAML::Node kalibr = root["cam0"];
  const Section camera(kalibr && kalibr.IsMap() ? kalibr : root, path);
  const YAML::Node date = camera.find({"calibration_date"});
  if (!date.IsDefined() || !date.IsScalar()) return std::nullopt;
  const auto number = [&](const char* key) {
    const YAML::Node node = camera.require({key}, "a number");
    double value = 0.0;
    if (!YAML::convert<double>::decode(node, value)) refuse(camera.where(node), key, shown(node), "a number");
    return value;
  };
  CameraNote note;
  note.date = date.Scalar();
  note.rms_px = number("rms_px");
  note.held_out_rms_px = number("held_out_rms_px");
  note.views = static_cast<int>(number("calibration_views"));
  const auto sigmas = [&](const char* key) {
    std::vector<double> values;
    for (const YAML::Node& item : camera.require({key}, "a list of numbers")) values.push_back(item.as<double>(0.0));
    return values;
  };
  note.sigma_intrinsics = sigmas("sigma_intrinsics");
  note.sigma_distortion = sigmas("sigma_distortion");
  return note;
}

RawCamera read_yaml(const std::filesystem::path& path, const std::string& text) {
  const YAML::Node root = load(path, text);
  const YAML::Node kalibr = root["cam0"];
  if (kalibr && kalibr.IsMap()) return read_kalibr(kalibr, path);
  return read_matrices(root, path);
}

}  // namespace calib
