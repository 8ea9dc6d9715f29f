// The camera's pose, and where virtual things land in the picture, against clips whose truth is known.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "ar/capture/file/open_source.h"
#include "ar/track/camera.h"
#include "ar/track/pose.h"
#include "ar/track/tag_map.h"
#include "calib/files/camera_file.h"
#include "tests/testing/run_program.h"

namespace cli {
namespace {

constexpr double kTagSizeM = 0.25;
constexpr int kFrames = 4;

// Tags in the middle and out to the corners of the picture, all flat on the ground.
const std::map<int, cv::Vec3d> kTags{{0, {0.0, 0.1, 0.002}},
                                     {1, {-0.8, -0.15, 0.002}},
                                     {2, {0.8, -0.15, 0.002}},
                                     {3, {-0.95, 0.4, 0.002}},
                                     {4, {0.95, 0.4, 0.002}}};

// Dim enough that nothing in the picture meets the highlight shoulder, where light is not linear any more.
constexpr const char* kPlaceTimeLight =
    "place: { latitude: 43.5, longitude: 5.4 }\n"
    "time: 2024-06-21T11:00:00Z\n"
    "exposure: { white_luminance: 80000 }\n";

std::string tags_text() {
  std::string text = fmt::format("tags:\n  family: tag36h11\n  size: {}\n  map:\n", kTagSizeM);
  for (const auto& [id, p] : kTags) {
    text += fmt::format("    - {{ id: {}, position: [{}, {}, {}], flat: {{ top_edge_heading_deg: 0 }} }}\n", id, p[0],
                        p[1], p[2]);
  }
  return text;
}

std::string synth_spec(const std::string& camera) {
  return fmt::format(
      "skyshaft_synth: 1\nsize: [1280, 720]\nfps: 30\nframes: {}\n{}noise: 1.0\nsamples: 16\nseed: 3\ncamera: {}\n"
      "path: {{ orbit: {{ center: [0, 0, 0], radius: 1.2, height: 1.6, from_deg: 178, to_deg: 182 }} }}\n{}"
      "ground: {{ surface: paving }}\n",
      kFrames, kPlaceTimeLight, camera, tags_text());
}

std::string base64(const std::vector<unsigned char>& bytes) {
  static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
    const unsigned word = (bytes[i] << 16U) | (bytes[i + 1] << 8U) | bytes[i + 2];
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[(word >> static_cast<unsigned>(shift)) & 63U];
  }
  return text;
}

// A glowing square of the tag's size, lying flat: glTF's y is up.
std::string square_gltf() {
  const float s = static_cast<float>(kTagSizeM / 2.0);
  const float corners[12] = {-s, 0, s, s, 0, s, s, 0, -s, -s, 0, -s};
  const unsigned short indices[6] = {0, 1, 2, 0, 2, 3};
  std::vector<unsigned char> bytes(sizeof corners + sizeof indices);
  std::copy_n(reinterpret_cast<const unsigned char*>(corners), sizeof corners, bytes.begin());
  std::copy_n(reinterpret_cast<const unsigned char*>(indices), sizeof indices, bytes.begin() + sizeof corners);
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],
"materials":[{{"doubleSided":true,"emissiveFactor":[1,1,1],
"pbrMetallicRoughness":{{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0,"roughnessFactor":1}}}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[{0},0,{0}],"max":[{1},0,{1}]}},
{{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":12}}],
"buffers":[{{"byteLength":60,"uri":"data:application/octet-stream;base64,{2}"}}]}})",
      -s, s, base64(bytes));
}

std::string scene_text() {
  std::string text = std::string("skyshaft: 1\n") + kPlaceTimeLight + tags_text() + "objects:\n";
  for (const auto& [id, p] : kTags) {
    text += fmt::format("  - {{ model: square.gltf, position: [{}, {}, {}] }}\n", p[0], p[1], p[2]);
  }
  return text;
}

struct PoseRow {
  ar::Rigid3 world_from_camera;
  std::string state;
};

std::vector<PoseRow> read_poses(const std::string& path) {
  std::vector<PoseRow> poses;
  const auto rows = read_csv(path);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto number = [&](std::size_t column) { return std::stod(rows[i].at(column)); };
    PoseRow pose;
    pose.state = rows[i][2];
    pose.world_from_camera.translation = {number(3), number(4), number(5)};
    pose.world_from_camera.rotation = ar::rotation_from_quaternion_wxyz({number(6), number(7), number(8), number(9)});
    poses.push_back(pose);
  }
  return poses;
}

// Luma as linear light (BT.709), for grey pictures.
cv::Mat1d linear_luma(const ar::Frame& frame) {
  cv::Mat1d luma(frame.format.height, frame.format.width);
  const bool limited = frame.format.color.range == ar::ColorRange::Limited;
  for (int y = 0; y < luma.rows; ++y) {
    for (int x = 0; x < luma.cols; ++x) {
      const double code = frame.plane[0][y * frame.stride_bytes[0] + x];
      const double v = limited ? (code - 16.0) / 219.0 : code / 255.0;
      luma(y, x) = v < 0.081 ? v / 4.5 : std::pow((v + 0.099) / 1.099, 1.0 / 0.45);
    }
  }
  return luma;
}

double bilinear(const cv::Mat1d& image, const cv::Point2d& p) {
  const int x = static_cast<int>(std::floor(p.x));
  const int y = static_cast<int>(std::floor(p.y));
  const double a = p.x - x;
  const double b = p.y - y;
  return (1 - b) * ((1 - a) * image(y, x) + a * image(y, x + 1)) +
         b * ((1 - a) * image(y + 1, x) + a * image(y + 1, x + 1));
}

// What each pixel of `out` holds of the square: out = in (1 - share) + square share.
cv::Mat1d share_of_square(const cv::Mat1d& in, const cv::Mat1d& out, double square) {
  cv::Mat1d share(in.size());
  for (int y = 0; y < in.rows; ++y) {
    for (int x = 0; x < in.cols; ++x) share(y, x) = (out(y, x) - in(y, x)) / (square - in(y, x));
  }
  return share;
}

// How a square's edge lies against the truth, along the tag's edge from corner a to corner b.
class EdgeRuler {
 public:
  EdgeRuler(const ar::CameraModel& camera, const ar::Rigid3& world_from_camera, const cv::Mat1d& share)
      : camera_(camera), camera_from_world_(world_from_camera.inverse()), share_(share) {}

  cv::Point2d pixel(const cv::Vec3d& x_in_world) const {
    const cv::Vec3d x = camera_from_world_ * x_in_world;
    return ar::project(camera_, {{x[0], x[1], x[2]}}).front();
  }

  // Offset of the drawn edge from the true one in px, outwards, at both ends: a line fitted to samples between.
  cv::Vec2d offsets_at_ends(const cv::Vec3d& a, const cv::Vec3d& b, const cv::Point2d& inside) const {
    double s = 0, st = 0, stt = 0, so = 0, sto = 0;
    for (double t = 0.1; t < 0.905; t += 0.02) {
      const double offset = offset_at(a + (b - a) * t, b - a, inside);
      s += 1, st += t, stt += t * t, so += offset, sto += t * offset;
    }
    const double slope = (s * sto - st * so) / (s * stt - st * st);
    const double start = (so - slope * st) / s;
    return {start, start + slope};
  }

  cv::Point2d normal(const cv::Vec3d& x, const cv::Vec3d& along, const cv::Point2d& inside) const {
    const cv::Point2d tangent = pixel(x + along * 0.01) - pixel(x - along * 0.01);
    cv::Point2d n(tangent.y, -tangent.x);
    n *= 1.0 / std::hypot(n.x, n.y);
    return n.dot(pixel(x) - inside) > 0.0 ? n : -n;
  }

 private:
  // The share of the square, summed along the normal from inside out, ends where the edge is.
  double offset_at(const cv::Vec3d& x, const cv::Vec3d& along, const cv::Point2d& inside) const {
    constexpr double kReach = 4.0;
    constexpr double kStep = 0.125;
    const cv::Point2d centre = pixel(x);
    const cv::Point2d n = normal(x, along, inside);
    double sum = 0.0;
    for (double r = -kReach + kStep / 2; r < kReach; r += kStep) sum += bilinear(share_, centre + n * r) * kStep;
    return sum - kReach;
  }

  const ar::CameraModel& camera_;
  const ar::Rigid3 camera_from_world_;
  const cv::Mat1d& share_;
};

// The corner's own offset from those of the two edges that meet there.
double corner_offset(const cv::Point2d& n1, double o1, const cv::Point2d& n2, double o2) {
  const double det = n1.x * n2.y - n1.y * n2.x;
  return std::hypot((o1 * n2.y - o2 * n1.y) / det, (o2 * n1.x - o1 * n2.x) / det);
}

// The largest offset of a corner of the square over that tag.
double worst_corner(const EdgeRuler& ruler, const cv::Vec3d& centre) {
  std::vector<cv::Vec3d> corners;
  const ar::Rigid3 world_from_tag = ar::flat_tag(centre, 0.0);
  for (const cv::Vec3d& corner : ar::corners_in_tag(kTagSizeM)) corners.push_back(world_from_tag * corner);
  const cv::Point2d inside = ruler.pixel(centre);
  double worst = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const cv::Vec3d &before = corners[(i + 3) % 4], &here = corners[i], &after = corners[(i + 1) % 4];
    const double o1 = ruler.offsets_at_ends(before, here, inside)[1];
    const double o2 = ruler.offsets_at_ends(here, after, inside)[0];
    const cv::Point2d n1 = ruler.normal(here, here - before, inside);
    const cv::Point2d n2 = ruler.normal(here, after - here, inside);
    worst = std::max(worst, corner_offset(n1, o1, n2, o2));
  }
  return worst;
}

class Accuracy : public ::testing::Test {
 protected:
  // Films the tags with that camera and runs the program on it, losslessly.
  void film_and_process(const std::string& camera) {
    folder_.write("square.gltf", square_gltf());
    Result result = skyshaft({"synth", folder_.write("spec.yaml", synth_spec(camera)), "-o", folder_.path("clip.mp4")});
    ASSERT_EQ(result.status, 0) << result.err;
    result = skyshaft({"process", folder_.path("clip.mp4"), "-o", folder_.path("out.mkv"), "--codec", "ffv1", "--scene",
                       folder_.write("scene.yaml", scene_text()), "--camera", folder_.path("clip.camera.yaml"),
                       "--poses", folder_.path("poses.csv")});
    ASSERT_EQ(result.status, 0) << result.err;
    truth_ = read_poses(folder_.path("clip.truth.csv"));
    found_ = read_poses(folder_.path("poses.csv"));
    ASSERT_EQ(truth_.size(), static_cast<std::size_t>(kFrames));
    ASSERT_EQ(found_.size(), truth_.size());
  }

  void expect_poses_right() const {
    double position = 0.0, angle = 0.0, distance = 0.0;
    for (std::size_t i = 0; i < truth_.size(); ++i) {
      const ar::Rigid3 error = truth_[i].world_from_camera.inverse() * found_[i].world_from_camera;
      position += error.translation.dot(error.translation);
      angle += std::pow(std::acos(std::clamp((cv::trace(error.rotation) - 1.0) / 2.0, -1.0, 1.0)), 2);
      distance += cv::norm(truth_[i].world_from_camera.translation) / static_cast<double>(truth_.size());
    }
    const auto n = static_cast<double>(truth_.size());
    EXPECT_LT(std::sqrt(position / n), 0.005 * distance);
    EXPECT_LT(std::sqrt(angle / n) * 180.0 / CV_PI, 0.3);
  }

  void expect_squares_on_tags() const {
    const ar::CameraModel camera = calib::read_camera_file(folder_.path("clip.camera.yaml"));
    const auto in = ar::open_source(folder_.path("clip.mp4"));
    const auto out = ar::open_source(folder_.path("out.mkv"));
    for (const PoseRow& truth : truth_) {
      const auto before = in->next();
      const auto after = out->next();
      ASSERT_TRUE(before && after);
      const cv::Mat1d picture = linear_luma(*after);
      const cv::Mat1d clean = linear_luma(*before);
      for (const auto& [id, centre] : kTags) {
        const cv::Mat1d unused;
        const double square = bilinear(picture, EdgeRuler(camera, truth.world_from_camera, unused).pixel(centre));
        const cv::Mat1d share = share_of_square(clean, picture, square);
        EXPECT_LT(worst_corner(EdgeRuler(camera, truth.world_from_camera, share), centre), 0.5)
            << "tag " << id << ", frame " << before->index;
      }
    }
  }

  const Folder folder_;
  std::vector<PoseRow> truth_;
  std::vector<PoseRow> found_;
};

TEST_F(Accuracy, PosesAndSquaresSitOnTheTagsThroughAPinhole) {
  ASSERT_NO_FATAL_FAILURE(film_and_process("{ fov_deg: 64 }"));
  expect_poses_right();
  expect_squares_on_tags();
}

TEST_F(Accuracy, PosesAndSquaresSitOnTheTagsThroughABarrelDistortion) {
  ASSERT_NO_FATAL_FAILURE(
      film_and_process("{ fov_deg: 64, model: plumb-bob, distortion: [-0.28, 0.09, 0.001, -0.0005] }"));
  expect_poses_right();
  expect_squares_on_tags();
}

}  // namespace
}  // namespace cli
