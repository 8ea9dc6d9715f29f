#pragma once

#include <array>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ar/capture/frame.h"

namespace ar {

// The families libapriltag 3.3.0 offers under these names: tag36h11, tag25h9, tag16h5, tagCircle21h7,
// tagStandard41h12, tagStandard52h13.
const std::vector<std::string>& tag_families();

struct Detection {
  std::string family;
  int id = 0;
  int hamming = 0;
  double margin = 0.0;                     // decision margin
  std::array<cv::Point2d, 4> corners_px;   // library's order; OpenCV's count (pixel centres at integers)
  cv::Point2d center_px;
};

struct DetectorOptions {
  std::vector<std::string> families{"tag36h11"};
  double quad_decimate = 1.0;
  double quad_sigma = 0.0;
  bool refine_edges = true;
  int threads = 1;
  int max_hamming = 1;
  double min_margin = 20.0;
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

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ar
