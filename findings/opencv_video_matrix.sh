#!/usr/bin/env bash
# OpenCV 4.6 decodes tagged BT.709 video with BT.601's matrix.
#
# Versions:   Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-videoio406) with FFmpeg 5.1.9-0+deb12u1
# Good guess: FFmpeg is inside, the stream says bt709, so that cv::VideoCapture's BGR is what ffmpeg itself makes of
#             it.
# Seen:       pure red (Y 63, Cb 102, Cr 240, tagged bt709, H.264): ffmpeg gives 254, 0, 0; OpenCV gives 232, 0, 1.
. "$(dirname "$0")/lib.sh"
fetch_ffmpeg
fetch_opencv core videoio
ffmpeg=(inside ffmpeg -nostdin -v error -y)
python3 -c '
import sys
sys.stdout.buffer.write((bytes([63]) * 4096 + bytes([102]) * 1024 + bytes([240]) * 1024) * 5)' >"$work/red.yuv"
"${ffmpeg[@]}" -f rawvideo -s 64x64 -r 25 -i "$work/red.yuv" -c:v libx264 -crf 1 -colorspace bt709 \
  -color_primaries bt709 -color_trc bt709 -color_range tv "$work/red.mp4"
cat >"$work/red.cpp" <<'CPP'
#include <cstdio>
#include <opencv2/videoio.hpp>
int main(int, char** arguments) {
  cv::VideoCapture capture(arguments[1], cv::CAP_FFMPEG);
  cv::Mat frame;
  capture >> frame;
  const auto pixel = frame.at<cv::Vec3b>(30, 30);
  std::printf("opencv_red %d\nopencv_green %d\nopencv_blue %d\n", pixel[2], pixel[1], pixel[0]);
}
CPP
compile "$work/red" "$work/red.cpp" -isystem "$root/usr/include/opencv4" -lopencv_videoio -lopencv_core
{
  inside "$work/red" "$work/red.mp4"
  "${ffmpeg[@]}" -i "$work/red.mp4" -frames:v 1 -f rawvideo -pix_fmt rgb24 - | od -An -tu1 -N3 |
    awk '{ print "ffmpeg_red", $1; print "ffmpeg_green", $2; print "ffmpeg_blue", $3 }'
} | tee "$work/out"
seen 'v["ffmpeg_red"] >= 252 && v["ffmpeg_green"] <= 2 && v["ffmpeg_blue"] <= 2' "$work/out"
seen 'v["opencv_red"] <= 236 && v["opencv_red"] >= 226' "$work/out"
