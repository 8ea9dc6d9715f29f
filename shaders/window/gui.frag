#version 310 es
// The panel: text and shapes out of one coverage texture.
precision mediump float;

uniform sampler2D font;

in vec2 v_uv;
in vec4 v_color;
layout(location = 0) out vec4 color;

void main() { color = vec4(v_color.rgb, v_color.a * texture(font, v_uv).r); }
