#!/usr/bin/env bash
# OpenCV reads an OpenEXR depth picture as all zeros, and calls it read.
#
# Versions:   Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-imgcodecs406), OpenEXR 3.1.5-5
# Good guess: cv::imread of a file whose one channel is "Z", the name that OpenEXR's documentation gives to depth,
#             returns the depths, or an empty matrix as for any file that it cannot read.
# Seen:       an 8x6 CV_32F matrix, every value 0. The same numbers in a channel "Y" are read right. A file whose
#             channels are "beauty.R", "beauty.G" and "beauty.B" gives an empty matrix.
. "$(dirname "$0")/lib.sh"
fetch_opencv core imgproc imgcodecs
fetch libopenexr-3-1-30=3.1.5-5 libopenexr-dev=3.1.5-5 libimath-3-1-29=3.1.6-1 libimath-dev=3.1.6-1
cat >"$work/depth.cpp" <<'CPP'
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <cstdio>
#include <opencv2/imgcodecs.hpp>
static std::vector<float> depths(48, 2.5f);
static void write(const std::string& file, const std::vector<std::string>& channels) {
  Imf::Header header(8, 6);
  Imf::FrameBuffer buffer;
  for (const auto& channel : channels) {
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    buffer.insert(channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(depths.data()), 4, 32));
  }
  Imf::OutputFile output(file.c_str(), header);
  output.setFrameBuffer(buffer);
  output.writePixels(6);
}
int main(int, char** arguments) {
  const std::string folder = arguments[1];
  const std::vector<std::pair<std::string, std::vector<std::string>>> files{
      {"Z", {"Z"}}, {"Y", {"Y"}}, {"beauty", {"beauty.R", "beauty.G", "beauty.B"}}};
  for (const auto& [name, channels] : files) {
    write(folder + "/" + name + ".exr", channels);
    const cv::Mat read = cv::imread(folder + "/" + name + ".exr", cv::IMREAD_UNCHANGED);
    double least = 0, most = 0;
    if (!read.empty()) cv::minMaxLoc(read, &least, &most);
    std::printf("%s_pixels %zu\n%s_least %g\n%s_most %g\n", name.c_str(), read.total(), name.c_str(), least,
                name.c_str(), most);
  }
}
CPP
compile "$work/depth" "$work/depth.cpp" -isystem "$root/usr/include/opencv4" -isystem "$root/usr/include/OpenEXR" \
  -isystem "$root/usr/include/Imath" -lopencv_imgcodecs -lopencv_core -lOpenEXR-3_1 -lImath-3_1
OPENCV_IO_ENABLE_OPENEXR=1 inside "$work/depth" "$work" 2>/dev/null | tee "$work/out"
seen 'v["Z_pixels"] == 48 && v["Z_least"] == 0 && v["Z_most"] == 0' "$work/out"
seen 'v["Y_pixels"] == 48 && v["Y_least"] == 2.5 && v["Y_most"] == 2.5 && v["beauty_pixels"] == 0' "$work/out"
