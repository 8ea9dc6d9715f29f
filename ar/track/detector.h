#pragma once

#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ar/capture/frame.h"

namespace ar {

// The families that are known by these names: tag36h11, tag25h9, tag16h5, tagCircle21h7,
// tagStandard41h12, tagStandard52h13.
const std::vector<std::string>& tag_families();

struct Detection {
  std::string family;
  int id = 0;
  int hamming = 0;
  double margin = 0.0;                    // decision margin
  std::array<cv::Point2d, 4> corners_px;  // library's order; OpenCV's count (pixel centres at integers)
  cv::Point2d center_px;
};

// Whether tags can be sought in a picture shrunk by that factor: the library knows 1, 1.5 and whole numbers. It shrinks
// by the whole part of any other, but counts pixels by the factor itself, and so finds nothing.
bool is_known_decimation(double quad_decimate);

struct DetectorOptions {
  std::vector<std::string> families{"tag36h11"};
  // 1, 1.5 or a whole number: quads are sought in a picture that much smaller, corners refined in the full one.
  double quad_decimate = 1.0;
  double quad_sigma = 0.0;   // blur before quads are sought, px of the shrunk picture
  bool refine_edges = true;  // without it corners are off by 0.25 px instead of 0.05 px
  int threads = 1;
  int max_hamming = 1;       // wrong bits corrected, 0 ... 2; at most 1 for tagStandard52h13
  double min_margin = 20.0;  // smallest decision margin; less is noise that looks like a tag
};

// Wraps libapriltag. Not thread-safe; one per thread.
class Detector {
 public:
  // Throws std::runtime_error that names an unknown family and lists the known ones.
  explicit Detector(const DetectorOptions& options = {});
  ~Detector();
  Detector(const Detector&) = delete;
  Detector& operator=(const Detector&) = delete;

  // Detections in a frame's luma (8 bits used as they lie; 10 bits are shifted; RGB is converted), by id.
  std::vector<Detection> detect(const Frame& frame);
  // In an 8-bit grey picture.
  std::vector<Detection> detect(const cv::Mat& gray8);
  // Only within those regions (px; cut to the picture). A tag counts once where regions overlap.
  std::vector<Detection> detect(const Frame& frame, const std::vector<cv::Rect>& regions);
  std::vector<Detection> detect(const cv::Mat& gray8, const std::vector<cv::Rect>& regions);

  // Quads are sought in the picture shrunk by that factor (1, 1.5 or a whole number), corners and bits always in the
  // full one.
  void set_decimate(double quad_decimate);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ar
