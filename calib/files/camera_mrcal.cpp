// mrcal's .cameramodel as RawCamera. The file is a Python dictionary with comments, whose optimization inputs may hold
// any character: the three keys that matter are looked up by themselves.

#include <fmt/format.h>

#include <regex>

#include "ar/error.h"
#include "calib/files/raw_camera.h"
#include "render/base/number.h"

namespace calib {
namespace {

// Comments go, line breaks stay.
std::string without_comments(const std::string& text) {
  std::string out;
  bool comment = false;
  for (char c : text) {
    if (c == '\n') comment = false;
    if (c == '#') comment = true;
    if (!comment) out += c;
  }
  return out;
}

std::string value_of(const std::string& text, const std::string& key, const std::string& form, const std::string& where,
                     const std::string& accepted) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex("['\"]" + key + "['\"]\\s*:\\s*" + form))) {
    refuse(where, key, "no such key", accepted);
  }
  return match[1];
}

std::vector<double> numbers_in(const std::string& list, const std::string& key, const std::string& where) {
  std::vector<double> values;
  std::string word;
  for (char c : list + ",") {
    if (c != ',' && std::isspace(static_cast<unsigned char>(c)) == 0) word += c;
    if (c != ',' || word.empty()) continue;
    const std::optional<double> value = render::parse_number(word);
    if (!value) refuse(where, key, "'" + word + "'", "a number");
    values.push_back(*value);
    word.clear();
  }
  return values;
}

std::string model_of(const std::string& lens, const std::string& where) {
  if (lens == "LENSMODEL_PINHOLE") return "none";
  if (lens == "LENSMODEL_OPENCV4" || lens == "LENSMODEL_OPENCV5") return "plumb_bob";
  if (lens == "LENSMODEL_OPENCV8" || lens == "LENSMODEL_OPENCV12") return "rational_polynomial";
  refuse(where, "lensmodel", "'" + lens + "'",
         "LENSMODEL_PINHOLE, LENSMODEL_OPENCV4, 5, 8 or 12 (mrcal-convert-lensmodel makes one from the others)");
}

}  // namespace

bool looks_like_mrcal(const std::string& text) {
  return text.find("LENSMODEL_") != std::string::npos && text.find("imagersize") != std::string::npos;
}

RawCamera read_mrcal(const std::filesystem::path& path, const std::string& text) {
  const std::string where = path.string();
  const std::string content = without_comments(text);
  const std::string list = "\\[([^\\]]*)\\]";
  RawCamera raw;
  raw.intrinsics_where = raw.distortion_where = raw.model_where = where;
  raw.model = model_of(value_of(content, "lensmodel", "['\"]([A-Za-z0-9_=]*)['\"]", where, "a LENSMODEL_..."), where);
  const auto size = numbers_in(value_of(content, "imagersize", list, where, "[width, height]"), "imagersize", where);
  if (size.size() != 2 || !(size[0] >= 1.0 && size[1] >= 1.0 && size[0] <= 1e5 && size[1] <= 1e5)) {
    refuse(where, "imagersize", fmt::format("{} numbers", size.size()), "[width, height] in px");
  }
  raw.width = static_cast<int>(size[0]);
  raw.height = static_cast<int>(size[1]);
  const auto v = numbers_in(value_of(content, "intrinsics", list, where, "a list of numbers"), "intrinsics", where);
  if (v.size() < 4) refuse(where, "intrinsics", fmt::format("{} numbers", v.size()), "fx, fy, cx, cy, distortion");
  raw.intrinsics = {v[0], 0.0, v[2], 0.0, v[1], v[3], 0.0, 0.0, 1.0};
  raw.distortion.assign(v.begin() + 4, v.end());
  return raw;
}

}  // namespace calib
