#include "tests/testing/board_film.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>
#include <stdexcept>

#include "ar/output/sink.h"
#include "ar/track/lens.h"
#include "ar/track/tag_face.h"
#include "calib/solve/initialization.h"

namespace calib::testing {
namespace {

constexpr int kSide = 2;  // samples of a pixel: kSide x kSide, each at its own instant of the shutter's time
constexpr float kWhite = 215.0F;
constexpr float kBlack = 35.0F;
constexpr float kBeyond = 110.0F;  // what is behind the board

// The board's face: brightness at a place of its plane.
class Face {
 public:
  explicit Face(const Board& grid)
      : columns_(grid.columns),
        rows_(grid.rows),
        first_(grid.tags.front().board_from_tag.translation),
        pitch_x_(grid.tags[1].board_from_tag.translation[0] - first_[0]),
        pitch_y_(grid.tags[static_cast<std::size_t>(columns_)].board_from_tag.translation[1] - first_[1]) {
    for (const BoardTag& tag : grid.tags) faces_.push_back(ar::make_tag_face(grid.family, tag.id, tag.size_m));
  }
  float at(double x, double y) const {
    const double u = (x - first_[0]) / pitch_x_;
    const double v = (y - first_[1]) / pitch_y_;
    if (!(u > -0.8 && v > -0.8 && u < columns_ - 0.2 && v < rows_ - 0.2)) return kBeyond;
    const int column = std::clamp(static_cast<int>(std::lround(u)), 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(std::lround(v)), 0, rows_ - 1);
    const double in_tag_x = (u - column) * pitch_x_;
    const double in_tag_y = (v - row) * pitch_y_;
    const ar::TagFace& face = faces_[static_cast<std::size_t>(row * columns_ + column)];
    const double half = 0.5 * face.side_m();
    if (std::abs(in_tag_x) >= half || std::abs(in_tag_y) >= half) return kWhite;
    return face.is_white(in_tag_x, in_tag_y) ? kWhite : kBlack;
  }

 private:
  int columns_;
  int rows_;
  cv::Vec3d first_;
  double pitch_x_;
  double pitch_y_;
  std::vector<ar::TagFace> faces_;
};

// Ideal places of all samples, row by row.
std::vector<cv::Vec2f> ideal_of_samples(const ar::CameraModel& camera) {
  std::vector<cv::Point2d> px;
  for (int y = 0; y < kSide * camera.height; ++y) {
    for (int x = 0; x < kSide * camera.width; ++x) px.emplace_back((x + 0.5) / kSide - 0.5, (y + 0.5) / kSide - 0.5);
  }
  std::vector<cv::Vec2f> ideal;
  ideal.reserve(px.size());
  for (const cv::Point2d& p : ar::undistort_to_ideal(camera, px)) {
    ideal.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y));
  }
  return ideal;
}

// The board's way through all stays.
class Way {
 public:
  Way(const ar::CameraModel& camera, const std::vector<Stay>& stays) : focal_(camera.intrinsics(0, 0)), stays_(stays) {}

  double duration_s() const {
    double sum = 0.0;
    for (const Stay& stay : stays_) sum += stay.move_s + stay.stay_s;
    return sum;
  }
  ar::Rigid3 at(double time_s) const {
    std::size_t i = 0;
    double begin = 0.0;
    while (i + 1 < stays_.size() && time_s >= begin + stays_[i].move_s + stays_[i].stay_s) {
      begin += stays_[i].move_s + stays_[i].stay_s;
      ++i;
    }
    const ar::Rigid3& to = stays_[i].camera_from_board;
    const ar::Rigid3& from = i > 0 ? stays_[i - 1].camera_from_board : to;
    const double t = std::clamp((time_s - begin) / stays_[i].move_s, 0.0, 1.0);
    ar::Rigid3 pose = between(from, to, t * t * (3.0 - 2.0 * t));
    const double shake = std::sin(2.0 * std::numbers::pi * 4.0 * time_s) * stays_[i].shake_px / focal_;
    pose.translation += cv::Vec3d(shake, 0.6 * shake, 0.0) * pose.translation[2];
    return pose;
  }

 private:
  static ar::Rigid3 between(const ar::Rigid3& a, const ar::Rigid3& b, double t) {
    const cv::Vec3d turn = ar::vector_from_rotation(b.rotation * a.rotation.t());
    return {ar::rotation_from_vector(turn * t) * a.rotation, a.translation * (1.0 - t) + b.translation * t};
  }

  double focal_;
  const std::vector<Stay>& stays_;
};

// From ideal places to places on the board's plane.
cv::Matx33d plane_from_ideal(const ar::Rigid3& pose) {
  cv::Matx33d h = pose.rotation;
  for (int r = 0; r < 3; ++r) h(r, 2) = pose.translation[r];
  return h.inv();
}

cv::Mat picture_of(const Face& face, const std::vector<cv::Vec2f>& ideal, const cv::Size& size,
                   const std::vector<cv::Matx33d>& instants) {
  cv::Mat_<float> picture(size, 0.0F);
  for (int y = 0; y < kSide * size.height; ++y) {
    for (int x = 0; x < kSide * size.width; ++x) {
      // Another instant at the same place of each pixel, so that no part of a pixel is seen early only.
      const auto instant = static_cast<std::size_t>((y % kSide) * kSide + x % kSide + x / kSide + 2 * (y / kSide));
      const cv::Matx33d& h = instants[instant % instants.size()];
      const cv::Vec2f& at = ideal[static_cast<std::size_t>(y) * static_cast<std::size_t>(kSide * size.width) +
                                  static_cast<std::size_t>(x)];
      const cv::Vec3d on = h * cv::Vec3d(at[0], at[1], 1.0);
      const float value = on[2] > 0.0 ? face.at(on[0] / on[2], on[1] / on[2]) : kBeyond;
      picture(y / kSide, x / kSide) += value / static_cast<float>(kSide * kSide);
    }
  }
  cv::GaussianBlur(picture, picture, {3, 3}, 0.5);
  return picture;
}

void write(ar::FrameSink& sink, const cv::Mat& picture, std::int64_t pts) {
  const ar::OutputFrame frame = sink.allocate();
  for (int y = 0; y < picture.rows; ++y) {
    std::memcpy(frame.plane[0] + y * frame.stride_bytes[0], picture.ptr(y), static_cast<std::size_t>(picture.cols));
  }
  for (std::size_t p = 1; p < 3; ++p) {
    std::memset(frame.plane.at(p), 128, static_cast<std::size_t>(frame.stride_bytes.at(p) * (picture.rows / 2)));
  }
  sink.write(frame, pts);
}

ar::SourceInfo source_of(const ar::CameraModel& camera, double fps) {
  ar::SourceInfo info;
  info.name = "film";
  info.format.width = camera.width;
  info.format.height = camera.height;
  info.format.color = {ar::ColorMatrix::Bt709, ar::ColorRange::Limited, ar::Transfer::Bt709, ar::Primaries::Bt709,
                       ar::ChromaSiting::Left};
  info.time_base = {1, 1000};
  info.frame_rate = {static_cast<int>(std::lround(fps * 1000.0)), 1000};
  return info;
}

}  // namespace

ar::Rigid3 pose_held(const Board& board, const ar::CameraModel& camera, const HeldView& view) {
  NextView hands(board, camera.width, camera.height);
  hands.set_camera(camera);
  const auto px = hands.points_px(view);
  if (!px) throw std::runtime_error("the board does not fit: " + words_of(view));
  Observation seen;
  seen.px = *px;
  for (int i = 0; i < static_cast<int>(px->size()); ++i) seen.points.push_back(i);
  const auto pose = best_pose_of(board, seen, ar::Lens(camera));
  if (!pose) throw std::runtime_error("no pose: " + words_of(view));
  return *pose;
}

void film_board(const std::filesystem::path& path, const Board& grid, const ar::CameraModel& camera,
                const std::vector<Stay>& stays, const Film& film) {
  const Face face(grid);
  const Way way(camera, stays);
  const std::vector<cv::Vec2f> ideal = ideal_of_samples(camera);
  ar::VideoSinkOptions options;
  options.preset = "ultrafast";
  options.crf = 8;
  const auto sink = ar::make_file_sink(path, source_of(camera, film.fps), options);
  cv::RNG noise(7);
  const int frames = static_cast<int>(way.duration_s() * film.fps);
  for (int f = 0; f < frames; ++f) {
    std::vector<cv::Matx33d> instants;
    for (int i = 0; i < kSide * kSide; ++i) {
      const double part = (i + 0.5) / (kSide * kSide) - 0.5;
      instants.push_back(plane_from_ideal(way.at(f / film.fps + part * film.shutter_s)));
    }
    cv::Mat picture = picture_of(face, ideal, {camera.width, camera.height}, instants);
    cv::Mat grain(picture.size(), CV_32F);
    noise.fill(grain, cv::RNG::NORMAL, 0.0, film.noise_codes);
    picture += grain;
    cv::Mat codes;
    picture.convertTo(codes, CV_8U);
    write(*sink, codes, std::lround(1000.0 * f / film.fps));
  }
  sink->finish();
}

}  // namespace calib::testing
