#!/usr/bin/env bash
# solvePnP with SOLVEPNP_IPPE_SQUARE reports success, and a tag behind the camera, for a square whose y points down.
#
# Version:    Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-calib3d406)
# Good guess: object points in AprilTag's frame (x right, y down, the same square, first corner top left) are as good
#             as OpenCV's (y up), since the points say where the corners are; a method that wants them otherwise says
#             so.
# Seen:       exact corners of a tag 0.6 m away. With y up: the pose, reprojection RMS 0 px. With y down: returns
#             true, a depth of -0.05 m (behind the camera) and a reprojection RMS over 1000 px. SOLVEPNP_IPPE solves
#             both. The manual gives the order that the method wants; nothing checks it.
. "$(dirname "$0")/lib.sh"
fetch_opencv core imgproc flann features2d calib3d
cat >"$work/square.cpp" <<'CPP'
#include <cstdio>
#include <opencv2/calib3d.hpp>
int main() {
  const cv::Matx33d camera(600, 0, 640, 0, 600, 360, 0, 0, 1);
  const double h = 0.05;
  const std::vector<cv::Point3d> up{{-h, h, 0}, {h, h, 0}, {h, -h, 0}, {-h, -h, 0}};
  const std::vector<cv::Point3d> down{{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
  for (const auto& [name, object] : {std::pair("up", up), std::pair("down", down)})
    for (const auto& [method, flag] :
         {std::pair("square", cv::SOLVEPNP_IPPE_SQUARE), std::pair("ippe", cv::SOLVEPNP_IPPE)}) {
      std::vector<cv::Point2d> seen, again;
      cv::projectPoints(object, cv::Vec3d(0.3, -0.4, 0.2), cv::Vec3d(0.02, -0.01, 0.6), camera, cv::noArray(), seen);
      cv::Vec3d turn, shift;
      const bool solved = cv::solvePnP(object, seen, camera, cv::noArray(), turn, shift, false, flag);
      cv::projectPoints(object, turn, shift, camera, cv::noArray(), again);
      std::printf("%s_%s_solved %d\n%s_%s_depth %.5f\n%s_%s_rms %.4f\n", method, name, solved, method, name, shift[2],
                  method, name, cv::norm(seen, again) / 2);
    }
}
CPP
compile "$work/square" "$work/square.cpp" -isystem "$root/usr/include/opencv4" -lopencv_calib3d -lopencv_core
inside "$work/square" | tee "$work/out"
seen 'v["square_up_solved"] == 1 && v["square_up_rms"] < 1e-3' "$work/out"
seen 'v["ippe_up_rms"] < 1e-3 && v["ippe_down_rms"] < 1e-3' "$work/out"
seen 'v["square_down_solved"] == 1 && v["square_down_depth"] < 0 && v["square_down_rms"] > 1000' "$work/out"
