#version 310 es
// A virtual surface again, now multisampled, for smooth edges. Its light is there already, shaded once a pixel: it takes
// what it has left in this pixel or, where another surface is before it there, in one beside. What has left nothing in
// any of them, smaller than a pixel, gives way.
// variant:
// variant: ALPHA_MASK
precision highp float;

#include "scene/facing.glsl"

uniform highp sampler2D shaded;        // rgb: light; a: facing_code(), 0 where no virtual surface is
uniform highp sampler2D shaded_depth;  // window depth

#ifdef ALPHA_MASK
#include "scene/mask.glsl"

uniform vec4 base_color;
uniform sampler2D base_color_texture;
uniform float alpha_cutoff;
in vec2 v_uv;
#endif

in vec3 v_normal;
layout(location = 0) out vec4 added;  // a: ALPHA_MASK: coverage; else what stays uncovered: 0

const float kFacingCosine = 0.9;  // 26 degrees: more than a code is off by, less than most edges turn

// How much less the surface in that pixel suits than one that lies as this one would there: by window depth, below 1;
// another that faces elsewhere, up to 2; none at all, 4.
float mismatch(vec4 there, ivec2 at, float expected_depth, vec3 normal) {
  float off = abs(texelFetch(shaded_depth, at, 0).r - expected_depth);
  if (dot(facing_of(there.a), normal) < kFacingCosine) off += 1.0;
  return there.a > 0.5 ? off : 4.0;
}

void main() {
  float alpha = 0.0;
#ifdef ALPHA_MASK
  alpha = mask_coverage(base_color.a * texture(base_color_texture, v_uv).a, alpha_cutoff, v_uv,
                        vec2(textureSize(base_color_texture, 0)));
#endif
  vec3 normal = normalize(v_normal) * (gl_FrontFacing ? 1.0 : -1.0);
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(shaded, 0) - 1;
  vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));

  vec4 light = texelFetch(shaded, at, 0);
  // Its own pixel first: within half a pixel along the surface, and what rounding leaves.
  float least = mismatch(light, at, gl_FragCoord.z, normal) - 0.5 * (abs(slope.x) + abs(slope.y)) - 2e-6;
  for (int i = 0; i < 4; ++i) {
    ivec2 step_px = i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5);
    ivec2 beside = clamp(at + step_px, ivec2(0), last);
    vec4 there = texelFetch(shaded, beside, 0);
    float off = mismatch(there, beside, gl_FragCoord.z + dot(slope, vec2(step_px)), normal);
    if (off < least) {
      least = off;
      light = there;
    }
  }
  if (least > 3.0) discard;
  added = vec4(light.rgb, alpha);
}
