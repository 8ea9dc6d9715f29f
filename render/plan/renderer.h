#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/base/picture.h"
#include "render/gl/context.h"
#include "render/images/image_io.h"
#include "render/plan/plan.h"
#include "render/shafts/shaft_technique.h"

namespace render {

// What a medium adds to and takes from a picture, upsampled to its size. Row 0 at the top.
struct MediumImage {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> rgba;  // in-scattered luminance_rgb in cd/m2, not exposed; transmittance
  // Metres along the camera's axis to what is seen, 1e9 and more: nothing. Empty where the technique's own picture is
  // smaller.
  std::vector<float> axis_distance_m;

  LinearImage in_scattered() const;
  LinearImage transmittance() const;  // grey
};

// Time of one pass of the last frame.
struct PassTime {
  std::string name;
  double gpu_ms = 0.0;   // GL timer query; 0 where the driver has none
  double wall_ms = 0.0;  // with glFinish around it when timing is on
  double cpu_ms = 0.0;   // processor time of all threads in it: what a software rasteriser costs on a busy machine too
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

  // The shafts alone. The plan has a shaft pass.
  MediumImage render_medium(const SceneState& scene, const Plan& plan);
  // Of the last shafts drawn, where their technique estimates its own error.
  std::optional<ShaftError> shafts_error() const;

  // The display-referred 8-bit sRGB form of a linear picture: exposure, highlight shoulder, sRGB, ordered dither.
  Image display_image(const LinearImage& linear, double exposure) const;

  void enable_timing(bool on);
  const std::vector<PassTime>& pass_times() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace render
