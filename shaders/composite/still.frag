#version 310 es
// Objects and medium over a background that is linear light already: a still without a camera picture. Values are
// pre-exposed; the result is divided by the exposure, so that it is luminance in cd/m2.
precision highp float;
precision highp int;

#include "composite/layers.glsl"

uniform highp sampler2D background;  // luminance_rgb, cd/m2
uniform float exposure;

layout(location = 0) out vec4 luminance_rgb;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Layers layers = layers_at(pixel, pixel, ivec2(0), pixel & 1);
  luminance_rgb = vec4(texelFetch(background, pixel, 0).rgb * layers.keep + layers.add / exposure, 1.0);
}
