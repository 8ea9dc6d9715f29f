#version 310 es
// Depth is all an occluder leaves behind; leaves and the like are cut out by their alpha.
// variant:
// variant: ALPHA_MASK
precision highp float;

#ifdef ALPHA_MASK
uniform sampler2D base_color_texture;
uniform float base_alpha;
uniform float alpha_cutoff;
in vec2 v_uv;
#endif

void main() {
#ifdef ALPHA_MASK
  if (texture(base_color_texture, v_uv).a * base_alpha < alpha_cutoff) discard;
#endif
}
