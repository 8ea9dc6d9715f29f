#version 310 es
// A video picture as a screen shows it: code values become coded RGB, which is what screens take.
// TWO_BYTES: samples of more than eight bits, as pairs of bytes.
// variant:
// variant: TWO_BYTES
precision highp float;

uniform sampler2D plane0;
uniform sampler2D plane1;
uniform sampler2D plane2;
uniform mat3 rgb_from_code;
uniform vec3 rgb_offset;

in vec2 v_uv;
layout(location = 0) out vec4 color;

float code(sampler2D plane) {
  vec2 bytes = texture(plane, v_uv).rg * 255.0;
#ifdef TWO_BYTES
  return bytes.x + 256.0 * bytes.y;
#else
  return bytes.x;
#endif
}

void main() { color = vec4(rgb_from_code * vec3(code(plane0), code(plane1), code(plane2)) + rgb_offset, 1.0); }
