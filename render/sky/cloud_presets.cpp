#include <stdexcept>

#include "render/sky/clouds.h"

namespace render {
namespace {

CloudLayer cumulus(double coverage, double optical_depth) {
  return {.height_m = 1400.0,
          .size_m = 2600.0,
          .coverage = coverage,
          .optical_depth = optical_depth,
          .softness = 0.5,
          .speed_mps = 7.0,
          .heading_rad = 1.2,
          .octaves = 7,
          .persistence = 0.55};
}

CloudLayer cirrus(double coverage, double optical_depth) {
  return {.height_m = 8500.0,
          .size_m = 14000.0,
          .coverage = coverage,
          .optical_depth = optical_depth,
          .softness = 0.8,
          .speed_mps = 25.0,
          .heading_rad = 1.6,
          .change_s = 2400.0,
          .octaves = 7,
          .persistence = 0.6};
}

CloudLayer altocumulus(double coverage, double optical_depth) {
  return {.height_m = 3800.0,
          .size_m = 3200.0,
          .coverage = coverage,
          .optical_depth = optical_depth,
          .softness = 0.5,
          .speed_mps = 14.0,
          .heading_rad = 1.5,
          .change_s = 1500.0};
}

CloudLayer stratus() {
  return {.height_m = 900.0,
          .size_m = 3500.0,
          .coverage = 1.6,  // beyond 1: no gaps, the thin places only let more light through
          .optical_depth = 34.0,
          .softness = 1.4,
          .speed_mps = 9.0,
          .heading_rad = 0.9};
}

}  // namespace

const std::vector<CloudPreset>& cloud_presets() {
  static const std::vector<CloudPreset> presets{
      {"clear", "no clouds", {}},
      {"light", "scattered cumulus under thin cirrus", {cumulus(0.28, 14.0), cirrus(0.35, 0.5)}},
      {"cloudy", "broken cumulus under altocumulus", {cumulus(0.55, 24.0), altocumulus(0.45, 5.0)}},
      {"overcast", "closed stratus", {stratus()}},
      {"night", "few cumulus and thin cirrus, for moonlit nights", {cumulus(0.22, 10.0), cirrus(0.4, 0.4)}}};
  return presets;
}

std::vector<std::string> cloud_preset_names() {
  std::vector<std::string> names;
  for (const CloudPreset& preset : cloud_presets()) names.push_back(preset.name);
  return names;
}

std::vector<CloudLayer> cloud_preset(const std::string& name) {
  std::string known;
  for (const CloudPreset& preset : cloud_presets()) {
    if (preset.name == name) return preset.layers;
    known += (known.empty() ? "" : ", ") + preset.name;
  }
  throw std::runtime_error("unknown cloud preset `" + name + "`\nknown presets: " + known);
}

}  // namespace render
