#version 310 es
// A virtual surface again, now multisampled, for smooth edges. Its light is there already, shaded once a pixel: it takes
// what it has left in this pixel or, where another surface is before it there, in one beside. What has left nothing in
// any of them, smaller than a pixel, gives way.
// variant:
// variant: ALPHA_MASK
precision highp float;

#include "scene/facing.glsl"

uniform highp sampler2D shaded;  // light
uniform highp sampler2D marks;   // surface_mark(), 0 where no virtual surface is

#ifdef ALPHA_MASK
#include "scene/mask.glsl"

uniform vec4 base_color;
uniform sampler2D base_color_texture;
uniform float alpha_cutoff;
in vec2 v_uv;
#endif

in vec3 v_normal;
layout(location = 0) out vec4 added;  // a: ALPHA_MASK: coverage; else what stays uncovered: 0

// A cell's turn counts as much as this relative difference in distance: the sides of a lath are told apart by their
// facing, a fruit's rim from the leaves behind by its distance.
const float kTurn = 0.002;

// How much less the surface in that pixel suits than one that would lie there at that near / z; none at all: 1e9.
float mismatch(ivec2 at, float expected, vec2 cell) {
  uint mark = floatBitsToUint(texelFetch(marks, at, 0).r);
  float off = abs(uintBitsToFloat(mark & ~255u) / expected - 1.0);
  vec2 turned = abs(vec2(float(mark & 15u), float((mark >> 4u) & 15u)) - cell);
  off += kTurn * max(max(turned.x, turned.y) - 1.0, 0.0);  // one cell is rounding
  return mark != 0u ? off : 1e9;
}

void main() {
  float alpha = 0.0;
#ifdef ALPHA_MASK
  alpha = mask_coverage(base_color.a * texture(base_color_texture, v_uv).a, alpha_cutoff, v_uv,
                        vec2(textureSize(base_color_texture, 0)));
#endif
  vec2 cell = facing_cell(gl_FrontFacing ? v_normal : -v_normal);
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(marks, 0) - 1;
  float here = max(1.0 - gl_FragCoord.z, 1e-20);
  vec2 slope = vec2(dFdx(here), dFdy(here));

  // Its own pixel first: within half a pixel along the surface, and what rounding leaves.
  ivec2 best = at;
  float least = mismatch(at, here, cell) - 0.5 * (abs(slope.x) + abs(slope.y)) / here - 1e-4;
  for (int i = 0; i < 4; ++i) {
    ivec2 step_px = i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5);
    ivec2 beside = clamp(at + step_px, ivec2(0), last);
    float off = mismatch(beside, max(here + dot(slope, vec2(step_px)), 1e-20), cell);
    if (off < least) {
      least = off;
      best = beside;
    }
  }
  if (least > 1e8) discard;
  added = vec4(texelFetch(shaded, best, 0).rgb, alpha);
}
