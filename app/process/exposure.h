#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ar/capture/frame.h"
#include "render/scene/scene_state.h"

namespace app {

// display-linear per cd/m2 from shutter, ISO and aperture; nothing when one of them is not told.
// EV100 = log2(N^2 / t) - log2(ISO / 100).
std::optional<double> exposure_from_metadata(const ar::ExposureInfo& info);

// Mean display-linear luma of frames, sampled on a grid, [0, 1]. Luma stands for luminance here: good enough for
// an estimate. `frames` is not empty and their colours are known.
double mean_linear_luma(const std::vector<const ar::Frame*>& frames);

// The exposure at which level 18 % grey under `horizontal_illuminance_lux` (> 0) has that mean: the plain estimate when
// nobody tells.
double exposure_from_mean(double mean_linear, double horizontal_illuminance_lux);

struct ExposureChoice {
  double exposure = 0.0;  // display-linear per cd/m2
  std::string origin;     // "the scene", "the video's metadata", ...
};

// The scene's where it has one, else what the first of `frames` tells, else the plain estimate from all of them in the
// light of `state`.
ExposureChoice choose_exposure(const std::optional<double>& of_scene, const render::SceneState& state,
                               const std::vector<const ar::Frame*>& frames);

}  // namespace app
