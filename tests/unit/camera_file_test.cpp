#include "calib/files/camera_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core/persistence.hpp>

#include "ar/error.h"
#include "ar/track/lens.h"

namespace calib {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class CameraFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("skyshaft_camera_") + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, const std::string& text) const {
    const fs::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::string refusal(const std::string& text) const {
    try {
      read_camera_file(file("bad.yaml", text));
    } catch (const ar::InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path folder_;
};

const std::string kOpenCv = R"(%YAML:1.0
---
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 535.9, 0., 342.2, 0., 536.1, 235.5, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -0.266, -0.0386, 0.00178, -0.00028, 0.238 ]
)";

const std::string kRos = R"(image_width: 640
image_height: 480
camera_name: head
camera_matrix: {rows: 3, cols: 3, data: [500, 0, 320, 0, 501, 240, 0, 0, 1]}
distortion_model: rational_polynomial
distortion_coefficients: {rows: 1, cols: 8, data: [0.1, 0.2, 0.001, 0.002, 0.3, 0.4, 0.5, 0.6]}
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
)";

const std::string kRosMessage = R"(height: 480
width: 640
distortion_model: plumb_bob
d: [0.1, -0.2, 0.001, 0.002, 0.0]
k: [500.0, 0.0, 320.0, 0.0, 501.0, 240.0, 0.0, 0.0, 1.0]
)";

const std::string kKalibr = R"(cam0:
  camera_model: pinhole
  intrinsics: [461.6, 460.3, 362.7, 248.1]
  distortion_model: equidistant
  distortion_coeffs: [-0.0027, 0.024, -0.027, 0.011]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
cam1: {camera_model: omni}
)";

TEST_F(CameraFile, ReadsOpenCvYaml) {
  const ar::CameraModel camera = read_camera_file(file("camera.yml", kOpenCv));
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(camera.intrinsics, cv::Matx33d(535.9, 0, 342.2, 0, 536.1, 235.5, 0, 0, 1));
  EXPECT_EQ(camera.lens, ar::LensModel::PlumbBob);
  EXPECT_EQ(camera.distortion, (std::vector<double>{-0.266, -0.0386, 0.00178, -0.00028, 0.238}));
  EXPECT_THAT(camera.origin, HasSubstr("camera.yml"));
}

TEST_F(CameraFile, ReadsWhatOpenCvItselfWrites) {
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << 900.25, 0, 640.5, 0, 901.75, 360.5, 0, 0, 1);
  const cv::Mat distortion = (cv::Mat_<double>(1, 4) << 0.01, -0.02, 0.003, -0.004);
  for (const char* name : {"camera.yml", "camera.xml"}) {
    const fs::path path = folder_ / name;
    cv::FileStorage out(path.string(), cv::FileStorage::WRITE);
    out << "image_width" << 1280 << "image_height" << 720 << "camera_matrix" << matrix << "fisheye_model" << 1
        << "distortion_coefficients" << distortion;
    out.release();
    const ar::CameraModel camera = read_camera_file(path);
    EXPECT_EQ(camera.width, 1280) << name;
    EXPECT_EQ(camera.intrinsics(1, 1), 901.75) << name;
    EXPECT_EQ(camera.lens, ar::LensModel::Fisheye) << name;
    EXPECT_EQ(camera.distortion, (std::vector<double>{0.01, -0.02, 0.003, -0.004})) << name;
  }
}

TEST_F(CameraFile, ReadsRosCameraInfoAsFileAndAsMessage) {
  const ar::CameraModel of_file = read_camera_file(file("ros.yaml", kRos));
  EXPECT_EQ(of_file.lens, ar::LensModel::Rational);
  EXPECT_EQ(of_file.distortion.size(), 8u);
  const ar::CameraModel of_message = read_camera_file(file("message.yaml", kRosMessage));
  EXPECT_EQ(of_message.lens, ar::LensModel::PlumbBob);
  EXPECT_EQ(of_message.intrinsics(0, 2), 320.0);
}

TEST_F(CameraFile, ReadsAKalibrCamchainsFirstCamera) {
  const ar::CameraModel camera = read_camera_file(file("camchain.yaml", kKalibr));
  EXPECT_EQ(camera.width, 752);
  EXPECT_EQ(camera.lens, ar::LensModel::Fisheye);
  EXPECT_EQ(camera.intrinsics, cv::Matx33d(461.6, 0, 362.7, 0, 460.3, 248.1, 0, 0, 1));
}

TEST_F(CameraFile, ZeroCoefficientsMakeAPinhole) {
  std::string text = kRosMessage;
  text.replace(text.find("[0.1, -0.2, 0.001, 0.002, 0.0]"), 30, "[0.0, 0.0, 0.0, 0.0, 0.0]");
  EXPECT_EQ(read_camera_file(file("zero.yaml", text)).lens, ar::LensModel::None);
}

TEST_F(CameraFile, WhatIsWrittenIsReadAgainToTheLastBit) {
  ar::CameraModel camera = read_camera_file(file("camchain.yaml", kKalibr));
  camera.intrinsics(0, 0) = 1.0 / 3.0 + 460.0;
  const std::vector<std::pair<ar::LensModel, std::size_t>> lenses{{ar::LensModel::None, 0},
                                                                  {ar::LensModel::PlumbBob, 4},
                                                                  {ar::LensModel::PlumbBob, 5},
                                                                  {ar::LensModel::Rational, 14},
                                                                  {ar::LensModel::Fisheye, 4}};
  for (const auto& [lens, count] : lenses) {
    camera.lens = lens;
    camera.distortion.assign(count, 0.1 / 3.0);
    const fs::path path = folder_ / "written.yaml";
    write_camera_file(path, camera);
    const ar::CameraModel again = read_camera_file(path);
    EXPECT_EQ(again.lens, lens);
    EXPECT_EQ(again.intrinsics, camera.intrinsics);
    EXPECT_EQ(again.distortion, camera.distortion);
    cv::FileStorage opencv(path.string(), cv::FileStorage::READ);
    cv::Mat matrix;
    opencv["camera_matrix"] >> matrix;
    EXPECT_EQ(matrix.at<double>(0, 0), camera.intrinsics(0, 0)) << "OpenCV reads it too";
  }
}

TEST_F(CameraFile, ErrorsNameLineKeyWhatWasFoundAndWhatIsAccepted) {
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(refusal(with(kOpenCv, "image_width: 640", "image_width: wide")),
              AllOf(HasSubstr("bad.yaml:3: image_width"), HasSubstr("'wide'"), HasSubstr("accepted: ")));
  EXPECT_THAT(refusal(with(kOpenCv, "0.00178", ".Nan")), AllOf(HasSubstr("bad.yaml:14"), HasSubstr(".Nan")));
  EXPECT_THAT(refusal(with(kOpenCv, "rows: 5", "rows: 4")),
              AllOf(HasSubstr("bad.yaml:14"), HasSubstr("rows x cols = 4")));
  EXPECT_THAT(refusal(with(kOpenCv, "535.9", "0.0")), AllOf(HasSubstr("bad.yaml:5"), HasSubstr("positive focal")));
  EXPECT_THAT(refusal(kOpenCv + "image_width: 641\n"), AllOf(HasSubstr("bad.yaml:15"), HasSubstr("second time")));
  EXPECT_THAT(refusal(with(kRos, "rational_polynomial", "omni_mei")),
              AllOf(HasSubstr("bad.yaml:5"), HasSubstr("'omni_mei'"), HasSubstr("plumb_bob")));
  EXPECT_THAT(refusal(with(kRos, "rational_polynomial", "equidistant")), HasSubstr("8 numbers for equidistant"));
  EXPECT_THAT(refusal(with(kKalibr, "camera_model: pinhole", "camera_model: ds")),
              AllOf(HasSubstr("bad.yaml:2"), HasSubstr("'ds'")));
  EXPECT_THAT(refusal(with(kKalibr, "equidistant", "fov")), AllOf(HasSubstr("bad.yaml:4"), HasSubstr("'fov'")));
  EXPECT_THAT(refusal("image_width: 640\n"), HasSubstr("image_height: found no such key"));
  EXPECT_THAT(refusal("a: [1, 2\nb: 3"), HasSubstr("bad.yaml:"));
  for (const char* bad : {"", "just text", "[1, 2, 3]", "<?xml version=\"1.0\"?><opencv_storage>", "<html></html>",
                          "cam0: [1]", "image_width: -1", "\x89PNG\r\n"}) {
    EXPECT_NE(refusal(bad), "accepted") << bad;
  }
}

TEST_F(CameraFile, AMissingFileAndAFolderAreNamed) {
  EXPECT_THROW(read_camera_file(folder_ / "absent.yaml"), ar::InputError);
  EXPECT_THROW(read_camera_file(folder_), ar::InputError);
}

}  // namespace
}  // namespace calib
