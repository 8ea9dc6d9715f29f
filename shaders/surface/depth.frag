#version 310 es
// Leaves its depth and nothing else.
// variant:
// variant: TEXTURED ALPHA_MASK
precision highp float;

#ifdef ALPHA_MASK
#include "surface/mask.glsl"

uniform vec4 base_color;
uniform sampler2D base_color_texture;
uniform float alpha_cutoff;
in vec2 v_uv;
#endif

void main() {
#ifdef ALPHA_MASK
  float alpha = base_color.a * texture(base_color_texture, v_uv).a;
  if (mask_coverage(alpha, alpha_cutoff, v_uv, vec2(textureSize(base_color_texture, 0))) < 0.5) discard;
#endif
}
