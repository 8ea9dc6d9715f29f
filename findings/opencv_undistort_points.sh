#!/usr/bin/env bash
# cv::undistortPoints is not the inverse of cv::projectPoints, even for a lens that is one-to-one.
#
# Version:    Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-calib3d406)
# Good guess: a point projected through a lens and undistorted again comes back to within a thousandth of a pixel.
# Seen:       focal length 600 px, k1 = -0.2, k2 = 0.012 (the radial polynomial rises all over the picture). Up to 0.3
#             of a focal length off the axis nothing is lost; at 1.03 the point comes back 1.97 px off, at 1.21 14 px.
#             It stops after five iterations and returns no sign of it. With criteria of its own, 100 iterations and
#             1e-9, the same call is exact to 1e-5 px.
. "$(dirname "$0")/lib.sh"
fetch_opencv core imgproc flann features2d calib3d
cat >"$work/undistort.cpp" <<'CPP'
#include <cstdio>
#include <opencv2/calib3d.hpp>
int main() {
  const cv::Matx33d camera(600, 0, 640, 0, 600, 360, 0, 0, 1);
  const std::vector<double> lens{-0.2, 0.012, 0, 0, 0};
  const std::vector<cv::Point3d> points{{0.25, 0.15, 1}, {0.9, 0.5, 1}, {1.05, 0.6, 1}};
  double rising = 1;  // least slope of r (1 + k1 r^2 + k2 r^4) within the farthest point
  for (double r = 0; r < 1.22; r += 0.01) rising = std::min(rising, 1 - 0.6 * r * r + 0.06 * r * r * r * r);
  std::printf("least_slope %.4f\n", rising);
  std::vector<cv::Point2d> seen, few, many;
  cv::projectPoints(points, cv::Vec3d(), cv::Vec3d(), camera, lens, seen);
  cv::undistortPoints(seen, few, camera, lens);
  const cv::TermCriteria until(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-9);
  cv::undistortPoints(seen, many, camera, lens, cv::noArray(), cv::noArray(), until);
  const char* names[] = {"near", "far", "farthest"};
  for (int i = 0; i < 3; ++i) {
    const cv::Point2d truth(points[i].x, points[i].y);
    std::printf("%s_default %.7f\n%s_asked %.7f\n", names[i], 600 * cv::norm(few[i] - truth), names[i],
                600 * cv::norm(many[i] - truth));
  }
}
CPP
compile "$work/undistort" "$work/undistort.cpp" -isystem "$root/usr/include/opencv4" -lopencv_calib3d -lopencv_core
inside "$work/undistort" | tee "$work/out"
seen 'v["least_slope"] > 0.2 && v["near_default"] < 1e-3' "$work/out"
seen 'v["far_default"] > 1.5 && v["farthest_default"] > 10' "$work/out"
seen 'v["far_asked"] < 1e-4 && v["farthest_asked"] < 1e-4' "$work/out"
