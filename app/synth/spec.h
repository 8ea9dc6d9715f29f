#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ar/track/camera.h"
#include "ar/track/tag_map.h"

namespace app::synth {

// What `skyshaft synth` is asked for; docs/synth.md describes the file. Metres, radians, seconds; z up, ground z = 0.

struct PathKey {
  double time_s = 0.0;
  glm::dvec3 position{0.0};
  glm::dvec3 target{0.0};
};

struct Orbit {
  glm::dvec3 center{0.0};  // looked at
  double radius_m = 3.0;   // horizontal distance from the centre
  double height_m = 1.6;   // of the camera above the ground
  double from_rad = 0.0;   // heading from the centre to the camera at the first and the last frame
  double to_rad = 0.0;
};

struct PathSpec {
  std::vector<PathKey> keys;   // in order of time; one key: a still camera
  std::optional<Orbit> orbit;  // instead of keys
  double sway_m = 0.0;         // amplitude of a hand's slow unrest
  double sway_rad = 0.0;
};

struct BoxSpec {
  glm::dvec3 size{1.0};
  glm::dvec3 position{0.0};  // of the middle
  double heading_rad = 0.0;  // clockwise from above
  std::string surface = "concrete";
};

struct PlantSpec {
  std::string kind = "tree";
  glm::dvec3 position{0.0};  // where it leaves the ground
  double height_m = 3.0;
  double width_m = 2.0;
};

struct GroundSpec {
  std::string surface = "paving";
  std::string around = "lawn";                         // beyond `extent`
  std::array<double, 4> extent{-1e3, -1e3, 1e3, 1e3};  // west, south, east, north of `surface`
};

struct Spec {
  std::filesystem::path file;
  int width = 1280;
  int height = 720;
  int fps_num = 30;
  int fps_den = 1;
  int frames = 150;
  int bit_depth = 8;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  std::chrono::sys_time<std::chrono::microseconds> time;
  std::string sky_model = "perez";
  double turbidity = 2.45;
  double clouds = 0.0;             // share of the sky with thin high cloud, drawn only
  std::optional<double> exposure;  // display-linear per cd/m2; absent: a grey card on the ground comes out as grey
  double shutter_s = 0.004;
  double noise_codes = 0.0;  // standard deviation at 18 % grey, in 8-bit codes of R', G', B'
  double blur_px = 0.0;      // standard deviation of the lens's and sensor's blur
  int samples = 16;          // a pixel, where there is detail
  std::uint32_t seed = 1;
  ar::CameraModel camera;
  PathSpec path;
  ar::TagMap tags;
  GroundSpec ground;
  std::vector<BoxSpec> boxes;
  std::vector<PlantSpec> plants;
  bool horizon = false;  // hills and trees far away

  double fps() const { return static_cast<double>(fps_num) / fps_den; }
  double time_of_frame_s(int frame) const { return frame / fps(); }
};

// Reads a spec. Throws std::runtime_error with file, line, key, what was found and what would be accepted.
Spec read_spec(const std::filesystem::path& file);

}  // namespace app::synth
