#pragma once

#include <glm/mat4x4.hpp>
#include <memory>

#include "ar/capture/frame.h"
#include "ar/output/sink.h"
#include "ar/photometry/exposure.h"
#include "ar/track/camera.h"
#include "ar/track/pose.h"
#include "render/base/picture.h"
#include "render/scene/scene_state.h"

namespace app {

// `ar` and `render` do not know each other: their types for the same things are converted here and nowhere else.

glm::dmat4 to_render(const ar::Rigid3& b_from_a);

// The camera without its pose. Pixel counts change from OpenCV's centres at integers to edges. A lens model becomes a
// map of all pixels (some 0.1 s for a large picture: make it once).
render::Camera to_render(const ar::CameraModel& camera);

// `format.color` must hold no Unknown (ar::guess_color); throws std::logic_error otherwise.
render::PictureFormat to_render(const ar::PixelFormat& format);
render::PictureView view_of(const ar::Frame& frame);
render::MutablePictureView view_of(const ar::OutputFrame& frame);

// What the exposure is estimated by.
ar::SceneLight scene_light_of(const render::SceneState& state);

}  // namespace app
