#version 310 es
// What each two neighbouring samples on a line say of the pixels between them. From lit surface to lit surface the dark
// part of the sunlight stays the same, however far they are; from shadowed to shadowed the lit one: that is kept. x, y: it
// at the two places; z, w: 1 / distance there, negative where the dark part is kept, and nearer than anything where it
// changes too much, or one of the two is beyond the line's beginning: a pixel's own line may be longer than its
// neighbours.
precision highp float;

uniform highp sampler2D samples;  // epipolar_samples.frag
uniform vec2 samples_texel;       // 1 / size
uniform float tolerance;          // of all sunlight, from one sample to the next

layout(location = 0) out vec4 pair;

void main() {
  vec4 a = textureLod(samples, gl_FragCoord.xy * samples_texel, 0.0);
  vec4 b = textureLod(samples, (gl_FragCoord.xy + vec2(1.0, 0.0)) * samples_texel, 0.0);
  vec2 change = abs(a.xy - b.xy);
  bool dark = a.w + b.w == 1.0 ? change.y < change.x : a.w + b.w > 1.0;
  vec2 kept = dark ? vec2(a.y, b.y) : vec2(a.x, b.x);
  bool steady = min(a.w, b.w) >= 0.0 && (dark ? change.y : change.x) <= tolerance * min(a.x + a.y, b.x + b.y);
  vec2 nearness = steady ? vec2(a.z, b.z) : vec2(1e9);
  pair = vec4(kept, dark ? -nearness : nearness);
}
