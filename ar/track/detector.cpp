#include "ar/track/detector.h"

#include <apriltag.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tag16h5.h>
#include <tag25h9.h>
#include <tag36h11.h>
#include <tagCircle21h7.h>
#include <tagStandard41h12.h>
#include <tagStandard52h13.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <tuple>

#include "ar/track/grey.h"
#include "ar/track/tag_family.h"
#include "render/base/check.h"

namespace ar {
namespace {

struct FamilyApi {
  std::string name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

const std::vector<FamilyApi>& family_api() {
  static const std::vector<FamilyApi> api{
      {"tag36h11", tag36h11_create, tag36h11_destroy},
      {"tag25h9", tag25h9_create, tag25h9_destroy},
      {"tag16h5", tag16h5_create, tag16h5_destroy},
      {"tagCircle21h7", tagCircle21h7_create, tagCircle21h7_destroy},
      {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy},
      {"tagStandard52h13", tagStandard52h13_create, tagStandard52h13_destroy},
  };
  return api;
}

}  // namespace

FamilyPtr make_family(const std::string& name) {
  const auto& api = family_api();
  const auto found = std::find_if(api.begin(), api.end(), [&](const FamilyApi& f) { return f.name == name; });
  if (found == api.end()) {
    throw std::runtime_error(fmt::format("unknown tag family '{}'\nknown: {}", name, fmt::join(tag_families(), ", ")));
  }
  return {found->create(), found->destroy};
}

namespace {

// The table of codes with two wrong bits takes 3 GB for the 48,714 codes of tagStandard52h13, whose 13 bits of distance
// make it needless; the library takes two at most in any family.
int correctable_bits(const apriltag_family_t& family, int max_hamming) {
  return std::clamp(max_hamming, 0, family.ncodes > 10000 ? 1 : 2);
}

void check(const DetectorOptions& options) {
  if (options.families.empty()) throw std::runtime_error("no tag family given\nname at least one, such as tag36h11");
  CHECK(is_known_decimation(options.quad_decimate));
  CHECK(options.quad_sigma >= 0.0);
  CHECK(options.threads >= 1);
  CHECK(options.max_hamming >= 0);
}

// AprilTag counts pixels from the picture's edge: the centre of its first pixel is at 0.5, OpenCV's at 0.
cv::Point2d opencv_from_apriltag_px(const double (&p)[2], const cv::Point& origin) {
  return {p[0] - 0.5 + origin.x, p[1] - 0.5 + origin.y};
}

Detection converted(const apriltag_detection_t& found, const cv::Point& origin) {
  Detection d;
  d.family = found.family->name;
  d.id = found.id;
  d.hamming = found.hamming;
  d.margin = static_cast<double>(found.decision_margin);
  for (std::size_t i = 0; i < 4; ++i) d.corners_px[i] = opencv_from_apriltag_px(found.p[i], origin);
  d.center_px = opencv_from_apriltag_px(found.c, origin);
  return d;
}

bool is_finite(const Detection& d) {
  return std::all_of(d.corners_px.begin(), d.corners_px.end(),
                     [](const cv::Point2d& p) { return std::isfinite(p.x) && std::isfinite(p.y); });
}

cv::Rect grown(const cv::Rect& box, int by) {
  return {box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by};
}

// One tag found in two overlapping regions counts once: centres closer than half the shortest edge.
bool same_tag(const Detection& a, const Detection& b) {
  if (a.id != b.id || a.family != b.family) return false;
  double edge = cv::norm(a.corners_px[0] - a.corners_px[3]);
  for (std::size_t i = 1; i < 4; ++i) edge = std::min(edge, cv::norm(a.corners_px[i] - a.corners_px[i - 1]));
  return cv::norm(a.center_px - b.center_px) < 0.5 * edge;
}

}  // namespace

const std::vector<std::string>& tag_families() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const FamilyApi& f : family_api()) all.push_back(f.name);
    return all;
  }();
  return names;
}

bool is_known_decimation(double quad_decimate) {
  return quad_decimate == 1.5 || (quad_decimate >= 1.0 && quad_decimate == std::floor(quad_decimate));
}

struct Detector::Impl {
  DetectorOptions options;
  std::vector<FamilyPtr> families;  // before `detector`, which refers to them until its end
  std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector{apriltag_detector_create(),
                                                                                apriltag_detector_destroy};
  cv::Mat grey;  // room for luma that has to be converted

  void detect_in(const cv::Mat& grey8, const cv::Rect& region, std::vector<Detection>& found);
  std::vector<Detection> run(const cv::Mat& view, const cv::Point& origin);
  void refine_at_border(const cv::Mat& grey8, Detection& detection);
};

Detector::Detector(const DetectorOptions& options) : impl_(std::make_unique<Impl>()) {
  check(options);
  impl_->options = options;
  apriltag_detector_t& td = *impl_->detector;
  for (const std::string& name : options.families) {
    FamilyPtr family = make_family(name);
    apriltag_detector_add_family_bits(&td, family.get(), correctable_bits(*family, options.max_hamming));
    impl_->families.push_back(std::move(family));
  }
  td.nthreads = options.threads;
  td.quad_decimate = static_cast<float>(options.quad_decimate);
  td.quad_sigma = static_cast<float>(options.quad_sigma);
  td.refine_edges = options.refine_edges;
}

Detector::~Detector() = default;

void Detector::set_decimate(double quad_decimate) {
  CHECK(is_known_decimation(quad_decimate));
  impl_->options.quad_decimate = quad_decimate;
  impl_->detector->quad_decimate = static_cast<float>(quad_decimate);
}

std::vector<Detection> Detector::Impl::run(const cv::Mat& view, const cv::Point& origin) {
  std::vector<Detection> found;
  // The library counts on some tiles of 4 x 4 px: no tag could be found in less anyway.
  const int smallest = static_cast<int>(16.0 * options.quad_decimate);
  if (view.cols < smallest || view.rows < smallest) return found;
  image_u8_t image{view.cols, view.rows, static_cast<int32_t>(view.step[0]), view.data};
  const std::unique_ptr<zarray_t, void (*)(zarray_t*)> list(apriltag_detector_detect(detector.get(), &image),
                                                            apriltag_detections_destroy);
  for (int i = 0; i < zarray_size(list.get()); ++i) {
    apriltag_detection_t* raw = nullptr;
    zarray_get(list.get(), i, static_cast<void*>(&raw));
    if (raw->hamming > options.max_hamming || static_cast<double>(raw->decision_margin) < options.min_margin) continue;
    const Detection d = converted(*raw, origin);
    if (is_finite(d)) found.push_back(d);
  }
  return found;
}

// The library looks for an edge some pixels to both sides, more of them the more it decimates. Where the picture ends
// before, it looks to one side only and puts the edge up to a pixel off. So once more without decimation, and with the
// picture's last rows and columns repeated outwards; not so where the tag itself is cut off, because its edges would be
// bent where they leave the picture.
void Detector::Impl::refine_at_border(const cv::Mat& grey8, Detection& detection) {
  const std::vector<cv::Point2f> corners(detection.corners_px.begin(), detection.corners_px.end());
  const cv::Rect box = cv::boundingRect(corners);
  const cv::Rect picture(0, 0, grey8.cols, grey8.rows);
  const int reach = static_cast<int>(options.quad_decimate) + 3;
  if (!options.refine_edges || (grown(box, reach) & picture) == grown(box, reach)) return;
  const int padding = (box & picture) == box ? 16 : 0;
  const cv::Rect crop = grown(box, 24 + std::max(box.width, box.height) / 4) & picture;
  cv::Mat padded;
  cv::copyMakeBorder(grey8(crop), padded, padding, padding, padding, padding,
                     cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  detector->quad_decimate = 1.0F;
  for (const Detection& again : run(padded, crop.tl() - cv::Point(padding, padding))) {
    if (same_tag(again, detection)) detection = again;
  }
  detector->quad_decimate = static_cast<float>(options.quad_decimate);
}

void Detector::Impl::detect_in(const cv::Mat& grey8, const cv::Rect& region, std::vector<Detection>& found) {
  cv::Mat view = grey8(region);
  // The library blurs in place when it does not decimate.
  if (options.quad_sigma > 0.0 && options.quad_decimate <= 1.0) view = view.clone();
  for (Detection& d : run(view, region.tl())) {
    refine_at_border(grey8, d);
    const bool known = std::any_of(found.begin(), found.end(), [&](const Detection& f) { return same_tag(f, d); });
    if (!known) found.push_back(d);
  }
}

std::vector<Detection> Detector::detect(const cv::Mat& gray8) {
  return detect(gray8, {cv::Rect(0, 0, gray8.cols, gray8.rows)});
}

std::vector<Detection> Detector::detect(const cv::Mat& gray8, const std::vector<cv::Rect>& regions) {
  CV_CheckTypeEQ(gray8.type(), CV_8UC1, "picture for tag detection");
  std::vector<Detection> found;
  for (const cv::Rect& region : regions) {
    const cv::Rect inside = region & cv::Rect(0, 0, gray8.cols, gray8.rows);
    if (!inside.empty()) impl_->detect_in(gray8, inside, found);
  }
  std::sort(found.begin(), found.end(), [](const Detection& a, const Detection& b) {
    return std::tie(a.family, a.id, a.center_px.x, a.center_px.y) <
           std::tie(b.family, b.id, b.center_px.x, b.center_px.y);
  });
  return found;
}

std::vector<Detection> Detector::detect(const Frame& frame) {
  return detect(grey8(frame, impl_->grey));
}

std::vector<Detection> Detector::detect(const Frame& frame, const std::vector<cv::Rect>& regions) {
  return detect(grey8(frame, impl_->grey), regions);
}

}  // namespace ar
