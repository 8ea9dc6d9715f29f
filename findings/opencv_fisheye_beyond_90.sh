#!/usr/bin/env bash
# OpenCV's fisheye model mirrors what is more than 90 degrees off the axis to the picture's other side.
#
# Version:    Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-calib3d406)
# Good guess: the model's radius is a polynomial of the angle, so that lenses of more than 180 degrees are just what
#             it is for: a point 100 degrees to the right lands farther right than one at 80.
# Seen:       equidistant lens, 300 px per radian, centre 640: a point 80 degrees to the right is projected to x =
#             1058.9, one at 89 to 1106.0, one at 91 to 174.0 and one at 100 to 221.1, which is where a point 80
#             degrees to the *left* is. The formula starts from x/z, which forgets the sign of z.
. "$(dirname "$0")/lib.sh"
fetch_opencv core imgproc flann features2d calib3d
cat >"$work/fisheye.cpp" <<'CPP'
#include <cstdio>
#include <opencv2/calib3d.hpp>
int main() {
  const cv::Matx33d camera(300, 0, 640, 0, 300, 480, 0, 0, 1);
  for (int degrees : {80, 89, 91, 100, -80}) {
    const double angle = degrees * CV_PI / 180;
    const std::vector<cv::Point3d> point{{std::sin(angle), 0, std::cos(angle)}};
    std::vector<cv::Point2d> seen;
    cv::fisheye::projectPoints(point, seen, cv::Vec3d(), cv::Vec3d(), camera, cv::Vec4d(0, 0, 0, 0));
    std::printf("%d %.3f\n", degrees, seen[0].x);
  }
}
CPP
compile "$work/fisheye" "$work/fisheye.cpp" -isystem "$root/usr/include/opencv4" -lopencv_calib3d -lopencv_core
inside "$work/fisheye" | tee "$work/out"
seen 'v["80"] > 1058 && v["80"] < 1060 && v["89"] > 1105 && v["89"] < 1107' "$work/out"
seen 'v["91"] < 175 && (v["100"] - v["-80"])^2 < 1e-4' "$work/out"
