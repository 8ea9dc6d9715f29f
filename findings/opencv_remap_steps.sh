#!/usr/bin/env bash
# cv::remap moves a picture by whole steps of 1/32 px, even one of floats.
#
# Version:    Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-imgproc406)
# Good guess: with a float picture, float maps and INTER_LINEAR the samples are taken where the maps say, to float
#             precision.
# Seen:       a ramp of one grey level a pixel, read 0.005, 0.015, 0.016, 0.03 and 0.05 px to the right, differs by 0,
#             0, 0.03125, 0.03125 and 0.0625: multiples of 1/32. Places are rounded, to either side.
. "$(dirname "$0")/lib.sh"
fetch_opencv core imgproc
cat >"$work/remap.cpp" <<'CPP'
#include <cstdio>
#include <opencv2/imgproc.hpp>
int main() {
  cv::Mat ramp(8, 64, CV_32F), read;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 64; ++x) ramp.at<float>(y, x) = static_cast<float>(x);
  for (const char* shift : {"0.005", "0.015", "0.016", "0.03", "0.05", "0.25"}) {
    cv::Mat x_map(8, 63, CV_32F), y_map(8, 63, CV_32F);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 63; ++x)
        x_map.at<float>(y, x) = static_cast<float>(x + std::atof(shift)), y_map.at<float>(y, x) = static_cast<float>(y);
    cv::remap(ramp, read, x_map, y_map, cv::INTER_LINEAR);
    std::printf("%s %.5f\n", shift, read.at<float>(4, 20) - 20);
  }
}
CPP
compile "$work/remap" "$work/remap.cpp" -isystem "$root/usr/include/opencv4" -lopencv_imgproc -lopencv_core
inside "$work/remap" | tee "$work/out"
seen 'v["0.005"] == 0 && v["0.015"] == 0 && v["0.016"] == 0.03125 && v["0.03"] == 0.03125' "$work/out"
seen 'v["0.05"] == 0.0625 && v["0.25"] == 0.25' "$work/out"
