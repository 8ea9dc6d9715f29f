#pragma once

#include <GLES3/gl31.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "render/scene/scene_state.h"
#include "render/scene/view.h"
#include "render/shadow/cascades.h"
#include "render/shadow/sun_shadow.h"
#include "render/shafts/shaft_settings.h"

namespace render {

// Everything a technique may use. Borrowed for the call.
struct ShaftInputs {
  const SceneState& scene;  // scene.medium is present
  const View& view;         // the ideal picture that `depth` belongs to
  GLuint depth = 0;         // ideal depth, view.width x view.height (View says what it means); 0: nothing in view
  const SunShadow& shadow;  // up to date with `scene`
  std::span<const Cascade> medium = {};  // CascadedShadow's, for techniques that gain by it (ShaftTechniqueInfo)
  // The view's pixels in which the medium may be seen: x, y, width, height. Nothing is computed elsewhere. Empty: all.
  glm::ivec4 region_px{0};
  // Whether the picture's distances are wanted where it is as large as the view. A smaller one always has them.
  bool with_distance = true;

  // What to look for occluders in, wherever they are.
  const SunShadow& occluders() const { return medium.size() == 1 ? *medium.front().maps : shadow; }
  // The parts that the light is to be summed over: those of the medium, or else one.
  std::vector<Cascade> parts() const {
    return medium.size() > 1 ? std::vector(medium.begin(), medium.end()) : std::vector{Cascade{&occluders(), {}}};
  }
};

// RGBA16F: rgb = in-scattered luminance_rgb * exposure, a = transmittance, row 0 at the top. A pixel of it looks along
// the ray through its centre: pixel (x, y) of width x height covers the ideal picture's pixels scaled to that size.
struct ShaftPicture {
  GLuint texture = 0;
  GLuint distance = 0;  // R32F, distance along the camera's axis at that pixel, metres, for depth-aware upsampling; 0:
                        // not wanted (ShaftInputs)
  int width = 0;
  int height = 0;
};

// What a technique knows of its own last picture's error.
struct ShaftError {
  double mean = 0.0;     // relative to the mean luminance
  double largest = 0.0;  // of any pixel, relative to the largest luminance
};

// One way to compute the light scattered towards the eye (docs/shafts.md).
class ShaftTechnique {
 public:
  virtual ~ShaftTechnique() = default;

  // The picture is owned by the technique and valid until its next draw.
  virtual const ShaftPicture& draw(const ShaftInputs& inputs) = 0;
  // Only those that estimate it.
  virtual std::optional<ShaftError> error() const { return std::nullopt; }
};

// By shaft_techniques(). Throws std::runtime_error for an unknown name, "auto" too.
std::unique_ptr<ShaftTechnique> make_shaft_technique(const ShaftSettings& settings);

}  // namespace render
