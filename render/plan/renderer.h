#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/composite/picture.h"
#include "render/gl/context.h"
#include "render/plan/plan.h"
#include "render/scene/image_io.h"

namespace render {

// Time of one pass of the last frame.
struct PassTime {
  std::string name;
  double gpu_ms = 0.0;   // GL timer query; 0 where the driver has none
  double wall_ms = 0.0;  // with glFinish around it when timing is on
};

// Executes plans. One per GL context; call from the thread on which the context is current.
class Renderer {
 public:
  explicit Renderer(gl::Context& context);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Composites the scene over `in` and writes `out` (same format; display-referred). With no virtual pass in the plan
  // `out` equals `in` exactly.
  void composite(const SceneState& scene, const Plan& plan, const PictureView& in, const MutablePictureView& out);

  // A still of the scene's own view, background = sky: unexposed luminance_rgb in cd/m2.
  LinearImage render_linear(const SceneState& scene, const Plan& plan);

  // The display-referred 8-bit sRGB form of a linear picture: exposure, highlight shoulder, sRGB, ordered dither.
  Image display_image(const LinearImage& linear, double exposure) const;

  void enable_timing(bool on);
  const std::vector<PassTime>& pass_times() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
