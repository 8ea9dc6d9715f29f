#version 310 es
// Each pixel from those of the small picture around it: Gaussian in distance across the picture, and falling with the
// relative difference of the distances to what is seen (Tomasi & Manduchi 1998; Kopf et al. 2007, joint upsampling).
precision highp float;

#include "shafts/ray.glsl"
#include "shafts/shading.glsl"
#include "shafts/view_depth.glsl"

uniform highp sampler2D small;  // low_res_visibility.frag
uniform vec2 small_px_per_px;
uniform int radius;

layout(location = 0) out vec4 scattered;
layout(location = 1) out float distance_along_axis;

float upscaled(float z) {
  const float kTolerance2 = 1e-3;  // squared relative difference at which a pixel counts half
  vec2 at = gl_FragCoord.xy * small_px_per_px - 0.5;
  ivec2 base = ivec2(floor(at));
  ivec2 last = textureSize(small, 0) - 1;
  float sum = 0.0;
  float weights = 0.0;
  for (int y = 1 - radius; y <= radius; ++y) {
    for (int x = 1 - radius; x <= radius; ++x) {
      ivec2 there = base + ivec2(x, y);
      vec2 found = texelFetch(small, clamp(there, ivec2(0), last), 0).xy;
      vec2 away = (vec2(there) - at) / float(radius);
      float difference = z / found.y - 1.0;
      float weight = exp(-2.0 * dot(away, away)) / (kTolerance2 + difference * difference);
      sum += weight * found.x;
      weights += weight;
    }
  }
  return sum / weights;
}

void main() {
  float z = view_distance(gl_FragCoord.xy);
  Ray ray = view_ray(gl_FragCoord.xy);
  vec2 segment = medium_segment(ray, z);
  MediumPath path = medium_along(ray, segment.x);
  distance_along_axis = z;
  scattered = medium_light(ray, path, segment, upscaled(z) * sunlight_to(path, segment.y));
}
