#!/usr/bin/env bash
# A camera file that OpenCV writes is not YAML, and one that is YAML OpenCV does not read.
#
# Versions:   Debian 12, OpenCV 4.6.0+dfsg-12 (libopencv-core406), yaml-cpp 0.7.0+dfsg-8+b1, PyYAML 6.0-3+b2
# Good guess: cv::FileStorage with a name that ends in .yml exchanges camera files with any other YAML library.
# Seen:       PyYAML refuses the first line, "%YAML:1.0" ("expected alphabetic or numeric character, but found ':'").
#             yaml-cpp takes that line, but not the spelling of a number that is not one: OpenCV writes ".Nan", and
#             as<double>() throws "bad conversion" (YAML spells .nan, .NaN or .NAN). The other way round
#             cv::FileStorage refuses the same contents without a first line that begins with "%YAML" ("Input file is
#             invalid"), and takes them with "%YAML 1.2".
. "$(dirname "$0")/lib.sh"
fetch_opencv core
fetch libyaml-cpp0.7=0.7.0+dfsg-8+b1 libyaml-cpp-dev=0.7.0+dfsg-8+b1 python3-yaml=6.0-3+b2
cat >"$work/exchange.cpp" <<'CPP'
#include <yaml-cpp/yaml.h>

#include <cstdio>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
int main(int, char** arguments) {
  const std::string folder = arguments[1];
  {
    cv::FileStorage file(folder + "/camera.yml", cv::FileStorage::WRITE);
    file << "image_width" << 640 << "rms" << std::numeric_limits<double>::quiet_NaN();
  }
  const YAML::Node camera = YAML::LoadFile(folder + "/camera.yml");
  std::printf("yaml_cpp_width %d\nyaml_cpp_spelling %s\n", camera["image_width"].as<int>(),
              camera["rms"].Scalar().c_str());
  try {
    camera["rms"].as<double>();
    std::printf("yaml_cpp_rms 1\n");
  } catch (const YAML::Exception&) {
    std::printf("yaml_cpp_rms 0\n");
  }
  for (const auto& [name, line] : {std::pair("plain", ""), std::pair("directive", "%YAML 1.2\n---\n")}) {
    std::ofstream(folder + "/other.yml") << line << "image_width: 640\n";
    try {
      cv::FileStorage file(folder + "/other.yml", cv::FileStorage::READ);
      std::printf("opencv_%s %d\n", name, static_cast<int>(file["image_width"]));
    } catch (const cv::Exception&) {
      std::printf("opencv_%s refused\n", name);
    }
  }
}
CPP
compile "$work/exchange" "$work/exchange.cpp" -isystem "$root/usr/include/opencv4" -lopencv_core -lyaml-cpp
inside "$work/exchange" "$work" 2>/dev/null | tee "$work/out"
PYTHONPATH=$root/usr/lib/python3/dist-packages /usr/bin/python3 - "$work/camera.yml" <<'PY' | tee -a "$work/out"
import sys, yaml
try:
    yaml.safe_load(open(sys.argv[1]))
    print('pyyaml read')
except yaml.scanner.ScannerError:
    print('pyyaml refused')
PY
seen 'v["yaml_cpp_width"] == 640 && v["yaml_cpp_spelling"] == ".Nan" && v["yaml_cpp_rms"] == 0' "$work/out"
seen 'v["opencv_plain"] == "refused" && v["opencv_directive"] == 640 && v["pyyaml"] == "refused"' "$work/out"
