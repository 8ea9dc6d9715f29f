#pragma once

#include <GLES3/gl31.h>

#include <cmath>
#include <limits>
#include <vector>

#include "render/gl/buffer.h"
#include "render/gl/framebuffer.h"
#include "render/gl/program.h"
#include "render/gl/texture.h"
#include "render/medium/medium.h"
#include "render/shadow/shadow_fit.h"

namespace render {

// How far the view reaches: for each square tile of the picture, the distance along the camera's axis, metres, of the
// farthest thing in it; infinite where a ray meets none.
struct VisibleDepth {
  static constexpr int kTilePx = 16;

  int columns = 0;
  int rows = 0;
  std::vector<double> axis_distance_m;  // columns * rows, row 0 at the top
};

// Finds it from a picture's depth (Lauritzen, Salvi & Lefohn 2010, "Sample distribution shadow maps").
class VisibleDepthPass {
 public:
  // `depth`: the ideal depth of that view (View says what it means); 0: nothing is in view. Waits for the GL; changes
  // framebuffer, viewport, program and state.
  VisibleDepth read(const View& view, GLuint depth);

 private:
  gl::Program program_{"lib/full_screen.vert", "shadow/farthest.frag"};
  gl::Texture farthest_;
  gl::Framebuffer framebuffer_;
  gl::VertexArray no_vertices_;
};

// A range of distances along the camera's axis, metres; all of them unless it says less.
struct AxisRange {
  double from_m = 0.0;
  double to_m = std::numeric_limits<double>::infinity();

  bool all() const { return from_m == 0.0 && std::isinf(to_m); }
  bool operator==(const AxisRange&) const = default;
};

// The part of a fit that the medium which is seen takes up within that range, a little larger, in steps of 1/32 of the
// whole, or at most a quarter of itself, so that a moving view seldom needs a new map; empty where none of that medium
// lies behind the fit's occluders.
ShadowFit fit_to_visible_medium(const ShadowFit& whole, int size_px, const View& view, const Medium& medium,
                                const VisibleDepth& seen, const AxisRange& range = {});

}  // namespace render
