#version 310 es
// What glass leaves of the light that comes through it, multiplied into the map: its own colour where it is thin,
// nothing where it is opaque; as render/shafts/reference/occluder_light.cpp. ALPHA_MASK: with a texture (occluder.vert).
// variant:
// variant: ALPHA_MASK
precision highp float;

uniform vec4 base_color;
#ifdef ALPHA_MASK
uniform sampler2D base_color_texture;
in vec2 v_uv;
#endif
layout(location = 0) out vec4 let_through;

void main() {
  vec4 base = base_color;
#ifdef ALPHA_MASK
  base *= texture(base_color_texture, v_uv);
#endif
  let_through = vec4((1.0 - base.a) * mix(vec3(1.0), base.rgb, base.a), 1.0);
}
