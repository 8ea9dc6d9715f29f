#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/base/picture.h"
#include "render/gl/context.h"
#include "render/images/image_io.h"
#include "render/plan/medium_image.h"
#include "render/plan/plan.h"
#include "render/shafts/shaft_technique.h"

namespace render {

// Time of one pass of the last frame.
struct PassTime {
  std::string name;
  double gpu_ms = 0.0;   // GL timer query; 0 where the driver has none, or draws in software
  double wall_ms = 0.0;  // with glFinish around it when timing is on
  double cpu_ms = 0.0;   // processor time of all threads in it: what a software rasteriser costs on a busy machine too
};

// Executes plans: their passes, one after the other. One per GL context; call from the thread on which the context is
// current. Throws std::logic_error for a plan that was made for another target.
class Renderer {
 public:
  explicit Renderer(gl::Context& context);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Target::Video. Composites the scene over `in` and writes `out` (same format; display-referred). Without passes in
  // the plan `out` equals `in` exactly. Throws std::runtime_error for a picture of another size than the camera's, and
  // as CompositePass::upload() does.
  void composite(const SceneState& scene, const Plan& plan, const PictureView& in, const MutablePictureView& out);

  // Target::Still, of the scene's own view, background = sky: unexposed luminance_rgb in cd/m2.
  LinearImage render_linear(const SceneState& scene, const Plan& plan);

  // Target::Medium. The plan has the feature of that name: the scene has a medium.
  MediumImage render_medium(const SceneState& scene, const Plan& plan);
  // Of the last frame's shafts, where their technique estimates its own error.
  std::optional<ShaftError> shafts_error() const;

  // The display-referred 8-bit sRGB form of a linear picture: exposure, highlight shoulder, sRGB, ordered dither.
  Image display_image(const LinearImage& linear, double exposure) const;

  void enable_timing(bool on);
  // Of the last frame: its plan's passes in their order. Empty where timing was off.
  const std::vector<PassTime>& pass_times() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
