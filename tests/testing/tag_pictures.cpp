#include "tests/testing/tag_pictures.h"

#include <apriltag.h>
#include <tag16h5.h>
#include <tag25h9.h>
#include <tag36h11.h>
#include <tagCircle21h7.h>
#include <tagStandard41h12.h>
#include <tagStandard52h13.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "ar/track/lens.h"
#include "ar/track/tag_map.h"

namespace ar::testing {
namespace {

struct Print {
  cv::Mat cells;              // one pixel a cell, 255 white
  double cells_per_size = 0;  // cells between the corners that AprilTag measures the size by
};

template <typename Create, typename Destroy>
Print print_of(Create create, Destroy destroy, int id) {
  apriltag_family_t* family = create();
  image_u8_t* image = apriltag_to_image(family, id);
  Print print;
  print.cells =
      cv::Mat(image->height, image->width, CV_8UC1, image->buf, static_cast<std::size_t>(image->stride)).clone();
  print.cells_per_size = family->width_at_border;
  image_u8_destroy(image);
  destroy(family);
  return print;
}

Print print_of(const std::string& family, int id) {
  if (family == "tag36h11") return print_of(tag36h11_create, tag36h11_destroy, id);
  if (family == "tag25h9") return print_of(tag25h9_create, tag25h9_destroy, id);
  if (family == "tag16h5") return print_of(tag16h5_create, tag16h5_destroy, id);
  if (family == "tagCircle21h7") return print_of(tagCircle21h7_create, tagCircle21h7_destroy, id);
  if (family == "tagStandard41h12") return print_of(tagStandard41h12_create, tagStandard41h12_destroy, id);
  return print_of(tagStandard52h13_create, tagStandard52h13_destroy, id);
}

// Grey of the ray (ideal coordinates) where it meets the print; negative where it misses.
double shade(const Print& print, const TagPicture& tag, const Rigid3& tag_from_camera, const cv::Point2d& ideal) {
  const cv::Vec3d along = tag_from_camera.rotation * cv::Vec3d(ideal.x, ideal.y, 1.0);
  const double t = -tag_from_camera.translation[2] / along[2];
  if (!(t > 0.0)) return -1.0;
  const cv::Vec3d hit = tag_from_camera.translation + t * along;
  const double cell = tag.size_m / print.cells_per_size;
  const double half = 0.5 * print.cells.cols;
  const double u = hit[0] / cell + half;
  const double v = hit[1] / cell + half;
  const bool paper = u >= -1.0 && v >= -1.0 && u < print.cells.cols + 1.0 && v < print.cells.rows + 1.0;
  if (!paper) return -1.0;
  const bool printed = u >= 0.0 && v >= 0.0 && u < print.cells.cols && v < print.cells.rows;
  if (!printed) return 215.0;
  return print.cells.at<std::uint8_t>(static_cast<int>(v), static_cast<int>(u)) > 127 ? 215.0 : 30.0;
}

// Where the paper of a tag is, from its corners with a broad margin; the rest of the picture is plain.
cv::Rect paper_box(const CameraModel& camera, const TagPicture& tag) {
  std::vector<cv::Point2f> outline;
  TagPicture paper = tag;
  paper.size_m = 2.6 * tag.size_m;  // tagStandard prints 9 cells where 5 count as its size, and a margin
  for (const cv::Point2d& p : true_corners_px(camera, paper)) {
    if (!std::isfinite(p.x)) return {0, 0, camera.width, camera.height};
    outline.emplace_back(p);
  }
  return cv::boundingRect(outline) & cv::Rect(0, 0, camera.width, camera.height);
}

}  // namespace

cv::Mat draw_tags(const CameraModel& camera, const std::vector<TagPicture>& tags, double noise_sigma, int samples,
                  std::uint64_t seed) {
  const Lens lens(camera);
  std::vector<Print> prints;
  std::vector<Rigid3> tag_from_camera;
  for (const TagPicture& tag : tags) {
    prints.push_back(print_of(tag.family, tag.id));
    tag_from_camera.push_back(tag.camera_from_tag.inverse());
  }
  cv::Mat picture(camera.height, camera.width, CV_32F, cv::Scalar(130.0));
  cv::Rect box;
  for (const TagPicture& tag : tags) box |= paper_box(camera, tag);
  for (int y = box.y; y < box.br().y; ++y) {
    for (int x = box.x; x < box.br().x; ++x) {
      double sum = 0.0;
      for (int s = 0; s < samples * samples; ++s) {
        const int column = s % samples;
        const int row = s / samples;
        const cv::Point2d pixel(x - 0.5 + (column + 0.5) / samples, y - 0.5 + (row + 0.5) / samples);
        const auto ideal = lens.ideal_from_pixel(pixel);
        double grey = 130.0;
        for (std::size_t i = 0; ideal && i < tags.size(); ++i) {
          const double hit = shade(prints[i], tags[i], tag_from_camera[i], *ideal);
          if (hit >= 0.0) grey = hit;
        }
        sum += grey;
      }
      picture.at<float>(y, x) = static_cast<float>(sum / (samples * samples));
    }
  }
  if (noise_sigma > 0.0) {
    cv::Mat noise(picture.size(), CV_32F);
    cv::RNG random(seed);
    random.fill(noise, cv::RNG::NORMAL, 0.0, noise_sigma);
    picture += noise;
  }
  cv::Mat gray8;
  picture.convertTo(gray8, CV_8U);
  return gray8;
}

std::array<cv::Point2d, 4> true_corners_px(const CameraModel& camera, const TagPicture& tag) {
  const Lens lens(camera);
  std::array<cv::Point2d, 4> corners;
  const auto in_tag = corners_in_tag(tag.size_m);
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = lens.project(tag.camera_from_tag * in_tag[i]).value_or(cv::Point2d(std::nan(""), std::nan("")));
  }
  return corners;
}

Frame frame_of(const cv::Mat& gray8, double time_s) {
  Frame frame;
  frame.format.width = gray8.cols;
  frame.format.height = gray8.rows;
  frame.plane[0] = gray8.data;
  frame.stride_bytes[0] = static_cast<std::ptrdiff_t>(gray8.step[0]);
  frame.time_s = time_s;
  return frame;
}

Rigid3 facing_tag(const cv::Vec3d& position_in_camera, double about_x_rad, double about_y_rad, double about_z_rad) {
  const cv::Matx33d turn = rotation_from_vector({0.0, 0.0, about_z_rad}) *
                           rotation_from_vector({0.0, about_y_rad, 0.0}) *
                           rotation_from_vector({about_x_rad, 0.0, 0.0});
  return {turn, position_in_camera};
}

}  // namespace ar::testing
