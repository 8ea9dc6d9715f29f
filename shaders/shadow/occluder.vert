#version 310 es
// Sees an occluder from the sun: an orthographic shadow map.
// variant:
// variant: ALPHA_MASK
precision highp float;

uniform mat4 map_clip_from_model;

layout(location = 0) in vec3 position;
#ifdef ALPHA_MASK
layout(location = 3) in vec2 uv;
out vec2 v_uv;
#endif

void main() {
#ifdef ALPHA_MASK
  v_uv = uv;
#endif
  gl_Position = map_clip_from_model * vec4(position, 1.0);
}
