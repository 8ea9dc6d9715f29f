#version 310 es
// A vertex of the panel, in window pixels from the top left.

uniform vec2 window_size;

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
out vec2 v_uv;
out vec4 v_color;

void main() {
  v_uv = uv;
  v_color = color;
  gl_Position = vec4(position.x / window_size.x * 2.0 - 1.0, 1.0 - position.y / window_size.y * 2.0, 0.0, 1.0);
}
