#!/usr/bin/env bash
# OpenCV 4.6 turns a phone's portrait video by half a turn too much.
#
# Versions:   Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-videoio406) with FFmpeg 5.1.9-0+deb12u1
# Good guess: cv::VideoCapture applies the file's display matrix (CAP_PROP_ORIENTATION_AUTO is 1) and shows what a
#             player shows.
# Seen:       an MP4 of 320x240, brightest at its top left, with the matrix of a phone held upright (a quarter turn
#             clockwise: left edge to the top). FFmpeg, from the same file, has the brightest quarter at the top
#             right; OpenCV has it at the bottom left. Both are 240x320.
. "$(dirname "$0")/lib.sh"
fetch_ffmpeg
fetch_opencv core imgproc imgcodecs videoio
ffmpeg=(inside ffmpeg -nostdin -v error -y)
python3 -c '
import sys
rows = (200 if x < 160 and y < 120 else 40 for y in range(240) for x in range(320))
sys.stdout.buffer.write((bytes(rows) + bytes([128]) * (320 * 120)) * 5)' >"$work/scene.yuv"
"${ffmpeg[@]}" -f rawvideo -s 320x240 -r 25 -i "$work/scene.yuv" -c:v libx264 -crf 5 "$work/flat.mp4"
# The track header's nine numbers follow 40 bytes after its version; 16.16 fixed point, the last column 2.30.
python3 - "$work" <<'PY'
import struct, sys
data = bytearray(open(sys.argv[1] + '/flat.mp4', 'rb').read())
at = data.index(b'tkhd') + 4 + 40
one = 1 << 16
assert struct.unpack('>9i', data[at:at + 36]) == (one, 0, 0, 0, one, 0, 0, 0, 1 << 30)
data[at:at + 36] = struct.pack('>9i', 0, one, 0, -one, 0, 0, 240 * one, 0, 1 << 30)
open(sys.argv[1] + '/upright.mp4', 'wb').write(data)
PY
cat >"$work/quarters.cpp" <<'CPP'
#include <cstdio>
#include <fstream>
#include <iterator>
#include <opencv2/videoio.hpp>
#include <vector>
static void report(const char* who, const cv::Mat& grey) {
  std::printf("%s_width %d\n%s_height %d\n", who, grey.cols, who, grey.rows);
  const char* names[] = {"top_left", "top_right", "bottom_left", "bottom_right"};
  for (int i = 0; i < 4; ++i)
    std::printf("%s_%s %d\n", who, names[i],
                grey.at<unsigned char>(i < 2 ? 20 : grey.rows - 20, i % 2 ? grey.cols - 20 : 20));
}
int main(int, char** arguments) {
  const std::string folder = arguments[1];
  cv::VideoCapture capture(folder + "/upright.mp4", cv::CAP_FFMPEG);
  std::printf("automatic %g\n", capture.get(cv::CAP_PROP_ORIENTATION_AUTO));
  cv::Mat frame, green;
  capture >> frame;
  cv::extractChannel(frame, green, 1);
  report("opencv", green);
  std::ifstream file(folder + "/upright.grey", std::ios::binary);
  std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.size() == 320 * 240) report("ffmpeg", cv::Mat(320, 240, CV_8U, bytes.data()));
}
CPP
"${ffmpeg[@]}" -i "$work/upright.mp4" -frames:v 1 -f rawvideo -pix_fmt gray "$work/upright.grey"
compile "$work/quarters" "$work/quarters.cpp" -isystem "$root/usr/include/opencv4" -lopencv_videoio -lopencv_core
inside "$work/quarters" "$work" | tee "$work/out"
seen 'v["automatic"] == 1 && v["opencv_width"] == 240 && v["ffmpeg_width"] == 240' "$work/out"
seen 'v["ffmpeg_top_right"] > 150 && v["ffmpeg_top_left"] < 60 && v["ffmpeg_bottom_left"] < 60' "$work/out"
seen 'v["opencv_bottom_left"] > 150 && v["opencv_top_left"] < 60 && v["opencv_top_right"] < 60' "$work/out"
