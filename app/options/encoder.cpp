#include "app/options/encoder.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace app {

void add_encoder_options(CLI::App& command, ar::VideoSinkOptions& options) {
  static const std::map<std::string, ar::VideoCodec> kCodecs{
      {"h264", ar::VideoCodec::H264}, {"hevc", ar::VideoCodec::Hevc}, {"ffv1", ar::VideoCodec::Ffv1}};
  command
      .add_option_function<std::string>(
          "--codec", [&options](const std::string& name) { options.codec = kCodecs.at(name); },
          "h264, hevc or ffv1 (lossless, .mkv); default: h264")
      ->check(CLI::IsMember({"h264", "hevc", "ffv1"}));
  command.add_option("--crf", options.crf, "Quality of h264 and hevc, 0 (best) to 51; default: 18")
      ->check(CLI::Range(0, 51));
  command
      .add_option("--preset", options.preset,
                  "x264's and x265's preset, ultrafast ... veryslow; default: " + options.preset)
      ->check(CLI::IsMember(
          {"ultrafast", "superfast", "veryfast", "faster", "fast", "medium", "slow", "slower", "veryslow"}));
}

}  // namespace app
