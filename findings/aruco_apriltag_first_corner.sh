#!/usr/bin/env bash
# OpenCV and libapriltag disagree by half a turn about which way up an AprilTag is.
#
# Version:    Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-contrib406), libapriltag3 3.3.0-1+b1
# Good guess: cv::aruco::detectMarkers lists corners clockwise from the top left, as its manual says, and the top left
#             is that of the tag as the AprilTag library draws it.
# Seen:       for all 60 tags drawn upright from libapriltag's own picture, the first corner is the bottom right one,
#             with DICT_APRILTAG_36h11. libapriltag's own p[0] is the bottom left one. A pose made from OpenCV's
#             corners is turned by 180 degrees about the tag's normal.
. "$(dirname "$0")/lib.sh"
fetch libapriltag3=3.3.0-1+b1 libapriltag-dev=3.3.0-1+b1
fetch_opencv core imgproc flann features2d calib3d contrib
cat >"$work/first.cpp" <<'CPP'
#include <apriltag/tag36h11.h>

#include <cstdio>
#include <map>
#include <opencv2/aruco.hpp>
#include <string>

#include "drawn_tag.h"
int main() {
  apriltag_family_t* family = tag36h11_create();
  apriltag_detector_t* detector = apriltag_detector_create();
  apriltag_detector_add_family(detector, family);
  const auto dictionary = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  const auto place = [](double x, double y) {
    return std::string(y < 90 ? "top_" : "bottom_") + (x < 100 ? "left" : "right");
  };
  std::map<std::string, int> count;
  for (unsigned id = 0; id < 60; ++id) {
    auto grey = draw(family, id, {100, 90, 80, 0}, 1);
    std::vector<std::vector<cv::Point2f>> found;
    std::vector<int> ids;
    cv::aruco::detectMarkers(cv::Mat(180, 200, CV_8U, grey.data()), dictionary, found, ids);
    if (ids.size() == 1 && ids[0] == static_cast<int>(id)) ++count["opencv_" + place(found[0][0].x, found[0][0].y)];
    image_u8_t picture = wrap(grey);
    zarray_t* detections = apriltag_detector_detect(detector, &picture);
    if (zarray_size(detections) != 1) continue;
    apriltag_detection_t* tag;
    zarray_get(detections, 0, &tag);
    if (tag->id == static_cast<int>(id)) ++count["apriltag_" + place(tag->p[0][0], tag->p[0][1])];
  }
  for (const auto& [name, times] : count) std::printf("%s %d\n", name.c_str(), times);
}
CPP
compile "$work/first" "$work/first.cpp" -isystem "$root/usr/include/opencv4" -lapriltag -lapriltag-utils \
  -lopencv_aruco -lopencv_core
inside "$work/first" | tee "$work/out"
seen 'v["opencv_bottom_right"] == 60 && v["apriltag_bottom_left"] == 60' "$work/out"
