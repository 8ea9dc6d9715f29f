#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calib/files/camera_file.h"

namespace calib {

// What a camera file says, before it is checked. `where` names file and line of each part for messages.
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
// What a calibration of ours left in the file; nothing where it was made elsewhere.
std::optional<CameraNote> read_note(const std::filesystem::path& path, const std::string& text);
// mrcal's .cameramodel: a Python dictionary.
bool looks_like_mrcal(const std::string& text);
RawCamera read_mrcal(const std::filesystem::path& path, const std::string& text);
RawCamera read_xml(const std::filesystem::path& path, const std::string& text);

// "WHERE: KEY: found X; accepted: Y" as ar::InputError.
[[noreturn]] void refuse(const std::string& where, const std::string& key, const std::string& found,
                         const std::string& accepted);

}  // namespace calib
