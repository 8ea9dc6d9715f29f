#version 310 es
// Objects and medium together as one layer over the real picture, in 8 bits, for a picture that is put together on the
// CPU: real * keep + add. `add` as the square root of its part of kMergedWhite, which is finest where the eye is.
precision highp float;
precision highp int;

#include "lib/shoulder.glsl"
#include "composite/layers.glsl"

layout(location = 0) out vec4 keep;
layout(location = 1) out vec4 add;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  Layers layers = layers_at(pixel, pixel, ivec2(0), pixel & 1);
  keep = vec4(layers.keep, 1.0);
  // Twice what makes white: more would be white too.
  add = vec4(sqrt(clamp(layers.add * (0.5 / kShoulderWhite), 0.0, 1.0)), 1.0);
}
