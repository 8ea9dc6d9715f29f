#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ar/track/camera.h"

namespace calib {

// What a camera file says, before it is judged. `where` names file and line of each part for messages.
struct RawCamera {
  int width = 0;
  int height = 0;
  std::vector<double> intrinsics;  // 9 numbers by rows
  std::vector<double> distortion;
  std::optional<std::string> model;  // as the file calls it
  std::string intrinsics_where;
  std::string distortion_where;
  std::string model_where;
};

RawCamera read_yaml(const std::filesystem::path& path, const std::string& text);
RawCamera read_xml(const std::filesystem::path& path, const std::string& text);

// "WHERE: KEY: found X; accepted: Y" as ar::InputError.
[[noreturn]] void refuse(const std::string& where, const std::string& key, const std::string& found,
                         const std::string& accepted);

}  // namespace calib
