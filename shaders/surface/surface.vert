#version 310 es
// A surface of a model, for depth, for the shadow on real things and for shading: one place for all three, so that
// their depths agree to the bit.
// variant:
// variant: TEXTURED
precision highp float;

uniform mat4 clip_from_model;
uniform mat4 local_from_model;
uniform mat3 local_normal_from_model;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
#ifdef TEXTURED
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
out vec4 v_tangent;
out vec2 v_uv;
#endif
out vec3 v_position;  // local frame
out vec3 v_normal;

invariant gl_Position;

void main() {
  v_position = (local_from_model * vec4(position, 1.0)).xyz;
  v_normal = local_normal_from_model * normal;
#ifdef TEXTURED
  v_tangent = vec4(mat3(local_from_model) * tangent.xyz, tangent.w);
  v_uv = uv;
#endif
  gl_Position = clip_from_model * vec4(position, 1.0);
}
