#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ar/capture/frame.h"

namespace ar {

// Exposures are display-linear values per cd/m2: what a luminance is multiplied by to become a level of the picture, in
// which 1 is white.

// Of a camera set to that EV at ISO 100: 1.0 is what saturates, 1.2 * 2^EV cd/m2 (ISO 12232:2019, saturation
// based speed, 78 / (0.65 * 100) = 1.2).
double exposure_from_ev100(double ev100);

// From shutter, ISO and aperture; nothing when one of them is not told.
// EV100 = log2(N^2 / t) - log2(ISO / 100).
std::optional<double> exposure_from_metadata(const ExposureInfo& info);

// Mean display-linear luma of frames, sampled on a grid, [0, 1]. Luma stands for luminance here: good enough for
// an estimate. `frames` is not empty and their colours are known.
double mean_linear_luma(const std::vector<const Frame*>& frames);

// The exposure at which level 18 % grey under `horizontal_illuminance_lux` (> 0) has that mean: the plain estimate when
// nobody tells.
double exposure_from_mean(double mean_linear, double horizontal_illuminance_lux);

struct ExposureChoice {
  double exposure = 0.0;
  std::string origin;  // "the scene", "the video's metadata", ...
};

// What the virtual scene is lit by when the frames are taken.
struct SceneLight {
  double horizontal_illuminance_lux = 0.0;  // on level ground under open sky, sun and sky together
  double default_exposure = 1.0;            // where there is neither light nor metadata
};

// The scene's where it has one, else what the first of `frames` tells, else the plain estimate from all of them in that
// light.
ExposureChoice choose_exposure(const std::optional<double>& of_scene, const SceneLight& light,
                               const std::vector<const Frame*>& frames);

}  // namespace ar
