#pragma once

#include <deque>
#include <optional>
#include <span>

#include "render/shafts/air_program.h"
#include "render/shafts/caster_map.h"
#include "render/shafts/closed_form.h"
#include "render/shafts/line_layout.h"
#include "render/shafts/march.h"
#include "render/shafts/shaft_target.h"
#include "render/shafts/slice_trees.h"

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
// itself. Each computation marches along its ray, or walks the min-max tree of its slice (Chen 2011, Tan 2020).
class Epipolar : public ShaftTechnique {
 public:
  Epipolar(const LineSettings& settings, const MarchSteps& steps);  // marches
  explicit Epipolar(const LineSettings& settings);                  // walks min-max trees

  const ShaftPicture& draw(const ShaftInputs& inputs) override;

 private:
  Epipolar(const LineSettings& settings, const gl::Defines& defines, bool sun_disc);
  // What of the casters of a part of the air the walk or the march looks at.
  struct PartCasters {
    CasterMap map{1};
    SliceTrees trees;
  };

  void bind(const gl::Program& program, const PartCasters& casters, const ShaftInputs& inputs, const LineLayout& layout,
            double beside_px) const;
  void draw_places(const gl::Program& program, const gl::Framebuffer& target, int more, int rows) const;
  void make_storage(const LineLayout& layout);
  void draw_samples(const ShaftInputs& inputs, std::span<const AirPart> parts, const LineLayout& layout);
  void draw_pairs(const LineLayout& layout);
  void draw_between(const ShaftInputs& inputs, const LineLayout& layout);
  void draw_alone(const ShaftInputs& inputs, std::span<const AirPart> parts, const LineLayout& layout);

  LineSettings settings_;
  std::optional<MarchSteps> steps_;
  std::deque<PartCasters> casters_;  // of the parts of the air
  AirProgram sample_;
  gl::Program pair_{"shafts/line_places.vert", "shafts/line_pairs.frag"};
  AirProgram between_;  // pixels that samples tell
  AirProgram alone_;    // all others
  gl::Texture samples_;
  gl::Texture pairs_;
  gl::Framebuffer to_samples_;
  gl::Framebuffer to_pairs_;
  gl::VertexArray no_vertices_;
  ShaftTarget target_{true};
  ClosedForm open_;
};

}  // namespace render
