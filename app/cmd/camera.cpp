// skyshaft camera: look at, convert, scale and crop camera files; undistort pictures.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "app/cmd/commands.h"
#include "app/error.h"
#include "app/exit_status.h"
#include "app/options/picture_size.h"
#include "app/process/output_files.h"
#include "ar/error.h"
#include "ar/track/lens.h"
#include "calib/files/camera_file.h"

namespace app {
namespace {

struct CameraArguments {
  std::string camera;
  std::string output;
  std::string format = "opencv";
  std::string size;
  std::vector<int> rectangle;
  std::string picture;
  double keep = 0.0;
  bool overwrite = false;
};

struct CameraFile {
  ar::CameraModel camera;
  std::optional<calib::CameraNote> note;
};

CameraFile read(const std::string& path) {
  return {calib::read_camera_file(path), calib::read_camera_note(path)};
}

void write(const CameraArguments& arguments, const CameraFile& file) {
  const calib::CameraFormat format = arguments.format == "ros"      ? calib::CameraFormat::Ros
                                     : arguments.format == "kalibr" ? calib::CameraFormat::Kalibr
                                                                    : calib::CameraFormat::OpenCv;
  write_whole(arguments.output, calib::camera_text(file.camera, format, file.note), arguments.overwrite);
}

const char* lens_name(ar::LensModel lens) {
  switch (lens) {
    case ar::LensModel::None:
      return "pinhole, no distortion";
    case ar::LensModel::PlumbBob:
      return "plumb-bob";
    case ar::LensModel::Rational:
      return "rational";
    case ar::LensModel::Fisheye:
      return "fisheye (equidistant)";
  }
  return "";
}

// Angle between the rays of two pixels, degrees; NaN where the lens has none.
double angle_deg(const ar::Lens& lens, const cv::Point2d& one, const cv::Point2d& other) {
  const auto a = lens.ideal_from_pixel(one);
  const auto b = lens.ideal_from_pixel(other);
  if (!a || !b) return std::nan("");
  const cv::Vec3d u = cv::normalize(cv::Vec3d(a->x, a->y, 1.0));
  const cv::Vec3d v = cv::normalize(cv::Vec3d(b->x, b->y, 1.0));
  return std::acos(std::clamp(u.dot(v), -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

int show(const CameraArguments& arguments) {
  const auto [camera, note] = read(arguments.camera);
  const ar::Lens lens(camera);
  const cv::Matx33d& k = camera.intrinsics;
  const double right = camera.width - 0.5;
  const double bottom = camera.height - 0.5;
  std::cout << fmt::format("picture      {} x {} px\n", camera.width, camera.height)
            << fmt::format("focal length {:.4f}, {:.4f} px\nprincipal pt {:.4f}, {:.4f} px\n", k(0, 0), k(1, 1),
                           k(0, 2), k(1, 2))
            << fmt::format("lens         {} [{:.6g}]\n", lens_name(camera.lens), fmt::join(camera.distortion, ", "))
            << fmt::format("field        {:.2f} deg across, {:.2f} deg high, {:.2f} deg from corner to corner\n",
                           angle_deg(lens, {-0.5, 0.5 * bottom}, {right, 0.5 * bottom}),
                           angle_deg(lens, {0.5 * right, -0.5}, {0.5 * right, bottom}),
                           angle_deg(lens, {-0.5, -0.5}, {right, bottom}));
  if (!note) {
    std::cout << "calibration  the file says nothing of it\n";
    return kDone;
  }
  std::cout << fmt::format("calibration  {}, {} views, RMS {:.4f} px, held out {:.4f} px\n", note->date, note->views,
                           note->rms_px, note->held_out_rms_px)
            << fmt::format("sigma        fx, fy, cx, cy {:.4g} px; distortion {:.4g}\n",
                           fmt::join(note->sigma_intrinsics, ", "), fmt::join(note->sigma_distortion, ", "));
  return kDone;
}

int convert(const CameraArguments& arguments) {
  check_files({{"CAMERA", arguments.camera}}, {{"-o", arguments.output}}, arguments.overwrite);
  write(arguments, read(arguments.camera));
  return kDone;
}

int scale(const CameraArguments& arguments) {
  check_files({{"CAMERA", arguments.camera}}, {{"-o", arguments.output}}, arguments.overwrite);
  const auto [width, height] = parse_picture_size("--size", arguments.size);
  CameraFile file = read(arguments.camera);
  const double factor = static_cast<double>(width) / file.camera.width;
  file.camera = ar::scaled(file.camera, width, height);
  if (file.note) {
    file.note->rms_px *= factor;
    file.note->held_out_rms_px *= factor;
    for (double& sigma : file.note->sigma_intrinsics) sigma *= factor;
  }
  write(arguments, file);
  return kDone;
}

int crop(const CameraArguments& arguments) {
  check_files({{"CAMERA", arguments.camera}}, {{"-o", arguments.output}}, arguments.overwrite);
  CameraFile file = read(arguments.camera);
  const std::vector<int>& r = arguments.rectangle;
  if (r[0] < 0 || r[1] < 0 || r[2] < 1 || r[3] < 1 || r[0] + r[2] > file.camera.width ||
      r[1] + r[3] > file.camera.height) {
    throw UsageError(fmt::format("--rect: {} does not lie within the picture of {}x{} px\naccepted: X,Y,WIDTH,HEIGHT",
                                 fmt::join(r, ","), file.camera.width, file.camera.height));
  }
  file.camera.width = r[2];
  file.camera.height = r[3];
  file.camera.intrinsics(0, 2) -= r[0];
  file.camera.intrinsics(1, 2) -= r[1];
  write(arguments, file);
  return kDone;
}

// The pinhole whose picture holds from none of the black beyond the lens (keep 0) to all of the picture (keep 1).
ar::CameraModel straight_camera(const ar::CameraModel& camera, double keep) {
  const ar::Lens lens(camera);
  double inner_x = 1e9;
  double inner_y = 1e9;
  double outer_x = 0.0;
  double outer_y = 0.0;
  const auto look = [&](double x, double y, bool side) {
    const auto ideal = lens.ideal_from_pixel({x, y});
    if (!ideal) return;
    double& inner = side ? inner_x : inner_y;
    double& outer = side ? outer_x : outer_y;
    const double off = std::abs(side ? ideal->x : ideal->y);
    inner = std::min(inner, off);
    outer = std::max(outer, off);
  };
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = static_cast<double>(camera.width) * i / kSteps - 0.5;
    const double y = static_cast<double>(camera.height) * i / kSteps - 0.5;
    for (double edge : {-0.5, camera.width - 0.5}) look(edge, y, true);
    for (double edge : {-0.5, camera.height - 0.5}) look(x, edge, false);
  }
  // Beyond 80 degrees off the axis a plane picture has no end.
  const double reach_x = std::min(5.7, inner_x + keep * (outer_x - inner_x));
  const double reach_y = std::min(5.7, inner_y + keep * (outer_y - inner_y));
  const double wide = 0.5 * camera.width / reach_x;
  const double high = 0.5 * camera.height / reach_y;
  const double focal = keep >= 0.5 ? std::min(wide, high) : std::max(wide, high);
  ar::CameraModel straight;
  straight.width = camera.width;
  straight.height = camera.height;
  straight.intrinsics = {focal, 0.0, 0.5 * (camera.width - 1), 0.0, focal, 0.5 * (camera.height - 1), 0.0, 0.0, 1.0};
  return straight;
}

cv::Mat undistorted(const cv::Mat& picture, const ar::CameraModel& camera, const ar::CameraModel& straight) {
  const ar::Lens lens(camera);
  const cv::Matx33d& k = straight.intrinsics;
  cv::Mat_<cv::Vec2f> from(straight.height, straight.width);
  for (int y = 0; y < from.rows; ++y) {
    for (int x = 0; x < from.cols; ++x) {
      const auto px = lens.pixel_from_ideal({(x - k(0, 2)) / k(0, 0), (y - k(1, 2)) / k(1, 1)});
      from(y, x) = px ? cv::Vec2f(static_cast<float>(px->x), static_cast<float>(px->y)) : cv::Vec2f(-10.0F, -10.0F);
    }
  }
  cv::Mat out;
  cv::remap(picture, out, from, cv::noArray(), cv::INTER_CUBIC, cv::BORDER_CONSTANT);
  return out;
}

int undistort(const CameraArguments& arguments) {
  const auto yaml = std::filesystem::path(arguments.output).replace_extension(".camera.yaml");
  check_files({{"CAMERA", arguments.camera}, {"PICTURE", arguments.picture}},
              {{"-o", arguments.output}, {"its camera file", yaml}}, arguments.overwrite);
  const cv::Mat picture = cv::imread(arguments.picture, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH);
  if (picture.empty()) {
    throw ar::InputError(
        fmt::format("{}: cannot be read as a picture\naccepted: PNG, JPEG, TIFF and the like", arguments.picture));
  }
  const ar::CameraModel camera = ar::scaled(calib::read_camera_file(arguments.camera), picture.cols, picture.rows);
  const ar::CameraModel straight = straight_camera(camera, arguments.keep);
  bool written = false;
  try {
    written = cv::imwrite(arguments.output, undistorted(picture, camera, straight));
  } catch (const cv::Exception&) {
    throw UsageError(
        fmt::format("{}: its ending says no picture format\naccepted: .png, .jpg, .tif", arguments.output));
  }
  if (!written) {
    throw std::runtime_error(
        fmt::format("{}: cannot be written\nis the folder writable, its disk not full?", arguments.output));
  }
  write_whole(yaml, calib::camera_text(straight, calib::CameraFormat::OpenCv, std::nullopt), arguments.overwrite);
  std::cout << fmt::format("{}: pinhole, focal length {:.2f} px; {}: its camera\n", arguments.output,
                           straight.intrinsics(0, 0), yaml.string());
  return kDone;
}

using Action = int (*)(const CameraArguments&);

CLI::App* add_part(CLI::App& camera, Program& program, const std::shared_ptr<CameraArguments>& arguments,
                   const char* name, const char* what, Action action, bool writes) {
  CLI::App* part = camera.add_subcommand(name, what);
  part->add_option("CAMERA", arguments->camera, "OpenCV, ROS camera_info, Kalibr camchain or mrcal .cameramodel file")
      ->required();
  if (writes) {
    part->add_option("-o,--output", arguments->output, "File to write")->required();
    part->add_flag("--overwrite", arguments->overwrite, "Replace a file that exists");
  }
  part->callback(
      [arguments, &program, action] { program.action = [arguments, action] { return action(*arguments); }; });
  return part;
}

}  // namespace

void add_camera_command(CLI::App& app, Program& program) {
  CLI::App* camera = app.add_subcommand("camera", "Show, convert, scale and crop camera files; undistort pictures");
  camera->require_subcommand(1);
  auto arguments = std::make_shared<CameraArguments>();
  add_part(*camera, program, arguments, "show", "What a camera file says", show, false);
  CLI::App* parts[] = {
      add_part(*camera, program, arguments, "convert", "The same camera in another format", convert, true),
      add_part(*camera, program, arguments, "scale", "The camera of pictures made smaller or larger", scale, true),
      add_part(*camera, program, arguments, "crop", "The camera of a part of the picture", crop, true)};
  for (CLI::App* part : parts) {
    part->add_option("--format", arguments->format, "opencv, ros or kalibr")
        ->check(CLI::IsMember({"opencv", "ros", "kalibr"}))
        ->capture_default_str();
  }
  parts[1]->add_option("--size", arguments->size, "WIDTHxHEIGHT, px; the same shape")->required();
  parts[2]
      ->add_option("--rect", arguments->rectangle, "X,Y,WIDTH,HEIGHT of the part, px")
      ->delimiter(',')
      ->expected(4)
      ->required();
  CLI::App* straighten = add_part(*camera, program, arguments, "undistort",
                                  "A picture as a pinhole sees it, and that camera beside it", undistort, true);
  straighten->add_option("PICTURE", arguments->picture, "Picture of that camera")->required();
  straighten->add_option("--keep", arguments->keep, "0: nothing black in the picture; 1: nothing of it lost")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  camera->footer(
      "Examples:\n  skyshaft camera show camera.yaml\n  skyshaft camera convert left.cameramodel -o left.yaml --format "
      "ros\n"
      "  skyshaft camera scale camera.yaml --size 1280x720 -o small.yaml\n"
      "  skyshaft camera undistort camera.yaml photo.jpg -o straight.png");
}

}  // namespace app
