#version 310 es
// The march's result, averaged along rows; shading.frag averages along columns.
precision highp float;

#include "shafts/tile_average.glsl"

uniform highp sampler2D lit_and_distance;

layout(location = 0) out vec2 averaged;

void main() {
  averaged = tile_average(lit_and_distance, ivec2(gl_FragCoord.xy), ivec2(1, 0));
}
