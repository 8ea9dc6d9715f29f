#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "app/process/conditions.h"
#include "app/scene_file/scene_file.h"
#include "render/daylight/daylight.h"
#include "render/scene/scene_state.h"

namespace app {

// Turns a scene file, a place and a time into what the renderer draws. The sun moves with the frames' time.
class SceneStateBuilder {
 public:
  // Throws UsageError when the sun's direction follows neither from place and time nor from the scene's `sun`, and
  // ar::InputError when the scene's sky cannot be made.
  SceneStateBuilder(const SceneFile& scene, const Conditions& conditions);

  // Everything but the camera, `elapsed_s` after the conditions' time. Sun and sky step once a second: the sun moves
  // 15 arc seconds in it, a hundredth of its own width.
  render::SceneState at(double elapsed_s);

  // The scene's exposure, where it has one.
  const std::optional<double>& exposure() const { return exposure_; }

 private:
  void light(std::int64_t second);
  render::Daylight daylight_or_input_error(const render::DaylightRequest& request) const;

  SceneSky sky_;
  render::GivenSun sun_;
  Conditions conditions_;
  std::optional<double> exposure_;
  std::optional<std::int64_t> second_;
  render::SceneState state_;
};

// Lux on open level ground from sun and sky, white-weighted by Rec. 709.
double horizontal_illuminance(const render::SceneState& state);

// The sun's direction, light, the sky and the medium, in words, in the log.
void log_light(const render::SceneState& state);

// The camera of the scene's `view` for a picture of that size, square pixels.
render::Camera camera_of_view(const SceneView& view, int width, int height);

}  // namespace app
