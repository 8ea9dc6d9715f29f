#!/usr/bin/env bash
# OpenCV puts ArUco corners half a pixel elsewhere with CORNER_REFINE_APRILTAG than with CORNER_REFINE_SUBPIX.
#
# Version:    Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-contrib406)
# Good guess: refinement methods differ in noise; all report corners in OpenCV's own count, where the centre of the
#             first pixel is (0, 0).
# Seen:       60 tags of 60 to 80 px, mean offset in x and y from the drawn corner, drawn corners counted from the
#             picture's edge (so that OpenCV's count is -0.5):
#               CORNER_REFINE_SUBPIX -0.50 px, CORNER_REFINE_APRILTAG -0.07 px.
#             The last is the AprilTag library's count, unshifted: 0.43 px from what cv::solvePnP wants.
. "$(dirname "$0")/lib.sh"
fetch libapriltag3=3.3.0-1+b1 libapriltag-dev=3.3.0-1+b1
fetch_opencv core imgproc flann features2d calib3d contrib
cat >"$work/corners.cpp" <<'CPP'
#include <apriltag/tag36h11.h>

#include <cstdio>
#include <opencv2/aruco.hpp>

#include "drawn_tag.h"
int main() {
  apriltag_family_t* family = tag36h11_create();
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  for (int method : {cv::aruco::CORNER_REFINE_SUBPIX, cv::aruco::CORNER_REFINE_APRILTAG}) {
    auto parameters = cv::aruco::DetectorParameters::create();
    parameters->cornerRefinementMethod = method;
    double x = 0, y = 0;
    int corners = 0;
    for (unsigned id = 0; id < 60; ++id) {
      auto grey = draw(family, id, random_tag(id), 2);
      std::vector<std::vector<cv::Point2f>> found;
      std::vector<int> ids;
      cv::aruco::detectMarkers(cv::Mat(180, 200, CV_8U, grey.data()), dictionary, found, ids, parameters);
      if (ids.size() != 1 || ids[0] != static_cast<int>(id)) continue;
      for (const auto& p : found[0])
        for (const auto& drawn : random_tag(id).corners())
          if (std::hypot(p.x - drawn[0], p.y - drawn[1]) < 5) x += p.x - drawn[0], y += p.y - drawn[1], ++corners;
    }
    const char* name = method == cv::aruco::CORNER_REFINE_SUBPIX ? "subpix" : "apriltag";
    std::printf("%s_mean_x %.4f\n%s_mean_y %.4f\n%s_corners %d\n", name, x / corners, name, y / corners, name, corners);
  }
}
CPP
compile "$work/corners" "$work/corners.cpp" -isystem "$root/usr/include/opencv4" -lapriltag -lapriltag-utils \
  -lopencv_aruco -lopencv_core
inside "$work/corners" | tee "$work/out"
seen 'v["subpix_corners"] == 240 && v["apriltag_corners"] == 240' "$work/out"
seen '(v["subpix_mean_x"] + 0.5)^2 < 0.0025 && (v["subpix_mean_y"] + 0.5)^2 < 0.0025' "$work/out"
seen 'v["apriltag_mean_x"]^2 < 0.01 && v["apriltag_mean_y"]^2 < 0.01' "$work/out"
