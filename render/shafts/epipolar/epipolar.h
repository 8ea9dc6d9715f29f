#pragma once

#include <deque>
#include <optional>
#include <span>

#include "render/shafts/epipolar/line_layout.h"
#include "render/shafts/epipolar/slice_trees.h"
#include "render/shafts/march/closed_form.h"
#include "render/shafts/march/march.h"
#include "render/shafts/medium_program.h"
#include "render/shafts/occluder_map.h"
#include "render/shafts/shaft_target.h"

namespace render {

// How densely the epipolar lines lie and are sampled, and when samples do for a pixel.
struct LineSettings {
  double line_px = 3.0;     // between lines, where they leave the picture
  double sample_px = 24.0;  // between samples on a line
  double tolerance = 0.1;   // of the lit part of the sunlight, from one sample to the next; above it, none in between
  int divisor = 1;
};

// Epipolar sampling (Engelhardt & Dachsbacher 2010): the light is computed at places along lines through the sun, and
// in between them interpolated along and across lines where depth and light allow; every other pixel is computed by
// itself. Each computation marches along its ray, or traverses the min-max tree of its slice (Chen 2011, Tan 2020).
class Epipolar : public ShaftTechnique {
 public:
  Epipolar(const LineSettings& settings, const MarchSteps& steps);  // marches
  explicit Epipolar(const LineSettings& settings);                  // traverses min-max trees

  const ShaftPicture& draw(const ShaftInputs& inputs) override;

 private:
  Epipolar(const LineSettings& settings, const gl::Defines& defines, bool sun_disc);
  // What of the occluders of a part of the medium the traversal or the march looks at.
  struct CascadeOccluders {
    OccluderMap map{1};
    SliceTrees trees;
  };

  void bind(const gl::Program& program, const CascadeOccluders& occluders, const ShaftInputs& inputs,
            const LineLayout& layout, double beside_px) const;
  void draw_samples_at(const gl::Program& program, const gl::Framebuffer& target, int more, int rows) const;
  void make_storage(const LineLayout& layout);
  void draw_samples(const ShaftInputs& inputs, std::span<const Cascade> parts, const LineLayout& layout);
  void draw_pairs(const LineLayout& layout);
  void draw_between(const ShaftInputs& inputs, const LineLayout& layout);
  void draw_alone(const ShaftInputs& inputs, std::span<const Cascade> parts, const LineLayout& layout);

  LineSettings settings_;
  std::optional<MarchSteps> steps_;
  std::deque<CascadeOccluders> occluders_;  // of the parts of the medium
  MediumProgram sample_;
  gl::Program pair_{"shafts/epipolar_samples.vert", "shafts/epipolar_pairs.frag"};
  MediumProgram between_;  // pixels that samples tell
  MediumProgram alone_;    // all others
  gl::Texture samples_;
  gl::Texture pairs_;
  gl::Framebuffer to_samples_;
  gl::Framebuffer to_pairs_;
  gl::VertexArray no_vertices_;
  ShaftTarget target_{true};
  ClosedForm open_;
};

}  // namespace render
