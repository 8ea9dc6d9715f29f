#version 310 es
#pragma skyshaft large_primitives
// One triangle over the whole viewport. v_uv is (0, 0) at the picture's top left and (1, 1) at its bottom right.

out highp vec2 v_uv;

void main() {
  vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  v_uv = corner;
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
