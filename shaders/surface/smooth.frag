#version 310 es
// A virtual surface again, now multisampled, for smooth edges. Its light is there already, shaded once a pixel: it
// takes what it has left in this pixel or, where another surface is before it there, in one beside. What has left
// nothing in any of them, smaller than a pixel, gives way.
// variant:
// variant: ALPHA_MASK
precision highp float;
precision highp int;

#include "surface/surface_mark.glsl"

uniform highp sampler2D shaded;  // light
uniform highp sampler2D marks;   // surface_mark(), 0 where no virtual surface is; unfiltered

#ifdef ALPHA_MASK
#include "surface/mask.glsl"

uniform vec4 base_color;
uniform sampler2D base_color_texture;
uniform float alpha_cutoff;
in vec2 v_uv;
#endif

in vec3 v_normal;
layout(location = 0) out vec4 added;  // a: ALPHA_MASK: coverage; else what stays uncovered: 0

// A step of facing() counts as much as this relative difference in distance: the sides of a lath are told apart by
// their facing, a fruit's rim from the leaves behind by its distance. A few steps are rounding and the bend of a
// surface.
const float kTurn = 1e-4;
const float kSameFacing = 8.0;

// How much less a pixel's surface suits than one that would be there at near / z = expected, `scale` being 1 / that;
// none at all: 1.
float mismatch(float mark, float expected, float scale, float own_facing) {
  uint bits = floatBitsToUint(mark);
  float turned = abs(float(bits & 255u) - own_facing);
  return abs(uintBitsToFloat(bits & ~255u) - expected) * scale + kTurn * max(turned - kSameFacing, 0.0);
}

void main() {
  float alpha = 0.0;
#ifdef ALPHA_MASK
  alpha = mask_coverage(base_color.a * texture(base_color_texture, v_uv).a, alpha_cutoff, v_uv,
                        vec2(textureSize(base_color_texture, 0)));
#endif
  float own = facing(gl_FrontFacing ? v_normal : -v_normal);
  vec2 pixel = 1.0 / vec2(textureSize(marks, 0));
  vec2 at = gl_FragCoord.xy * pixel;
  float here = max(1.0 - gl_FragCoord.z, 1e-20);
  float scale = 1.0 / here;
  float dx = dFdx(here);
  float dy = dFdy(here);

  vec4 off = vec4(mismatch(textureLodOffset(marks, at, 0.0, ivec2(-1, 0)).r, here - dx, scale, own),
                  mismatch(textureLodOffset(marks, at, 0.0, ivec2(1, 0)).r, here + dx, scale, own),
                  mismatch(textureLodOffset(marks, at, 0.0, ivec2(0, -1)).r, here - dy, scale, own),
                  mismatch(textureLodOffset(marks, at, 0.0, ivec2(0, 1)).r, here + dy, scale, own));
  // Its own pixel first: within half a pixel along the surface, and what rounding leaves.
  float centre = mismatch(textureLod(marks, at, 0.0).r, here, scale, own) - 0.5 * (abs(dx) + abs(dy)) * scale - 1e-4;
  float across = min(off.x, off.y);
  float along = min(off.z, off.w);
  float least = min(across, along);
  vec2 beside = across < along ? vec2(off.x < off.y ? -1.0 : 1.0, 0.0) : vec2(0.0, off.z < off.w ? -1.0 : 1.0);
  if (min(centre, least) > 0.9) discard;
  vec2 best = centre <= least ? vec2(0.0) : beside;
  added = vec4(textureLod(shaded, at + best * pixel, 0.0).rgb, alpha);
}
