#version 310 es
// What virtual things leave uncovered of each pixel; multiplied into the shadow on real surfaces.
precision highp float;

uniform highp sampler2D added;  // a: uncovered part

layout(location = 0) out vec4 multiplier;

void main() {
  multiplier = vec4(texelFetch(added, ivec2(gl_FragCoord.xy), 0).a);
}
