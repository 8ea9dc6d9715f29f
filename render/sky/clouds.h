#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "render/sky/sky_model.h"

namespace render {

// A layer of clouds: Perlin noise on a shell around the Earth that drifts and slowly changes.
struct CloudLayer {
  double height_m = 1500.0;
  double size_m = 2500.0;  // of the largest puffs
  double coverage = 0.4;   // share of the sky overhead that it covers; above 1 thickens what a full cover has left thin
  double optical_depth = 12.0;  // where it is thickest
  double softness = 0.25;       // of its edges, (0, 1]
  double speed_mps = 8.0;
  double heading_rad = 1.0;  // where it drifts to, clockwise from north
  double change_s = 600.0;   // its shapes are others after that time
  int octaves = 6;
  double persistence = 0.5;
};

// Weather as it is known by name.
struct CloudPreset {
  std::string name;
  std::string summary;             // Markdown, one line
  std::vector<CloudLayer> layers;  // none: no clouds
};

// All presets, in the order of the documents: clear, the default, is the first.
const std::vector<CloudPreset>& cloud_presets();

std::vector<std::string> cloud_preset_names();

// The layers of a preset, none for clear. Throws std::runtime_error that names an unknown preset and
// lists those there are.
std::vector<CloudLayer> cloud_preset(const std::string& name);

// A light that shines on the clouds: where it stands and what it gives a plane facing it, lux.
struct CloudLight {
  glm::dvec3 direction_in_world;
  glm::dvec3 illuminance_rgb;
};

// `sky` behind clouds that `lights` and the sky itself shine on. The same for the same seed and time.
std::unique_ptr<SkyModel> make_cloudy_sky(std::unique_ptr<SkyModel> sky, std::vector<CloudLayer> layers,
                                          std::vector<CloudLight> lights, double time_s, std::uint32_t seed);

}  // namespace render
