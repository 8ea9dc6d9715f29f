#version 310 es
// Where each epipolar slice (the plane through the eye, the sun and a line of the picture) runs across the shadow map:
// a straight line, cut into cells of one texel along the axis that it is nearer to (Tan 2020: without rectification).
precision highp float;

#define NO_DEPTH
#include "shafts/ray.glsl"
#include "shafts/lines.glsl"

uniform mat4 texels_from_local;  // texels, texels, depth steps
uniform vec2 map_size;

layout(location = 0) out vec4 slice;  // direction with its larger part +-1; where the first cell begins, texels; cells

void main() {
  Line line = line_of_row(int(gl_FragCoord.y));
  vec2 across = (mat3(texels_from_local) * view_ray(line.end).direction).xy;
  float largest = max(abs(across.x), abs(across.y));
  vec2 direction = largest > 1e-12 ? across / largest : vec2(1.0, 0.0);
  vec2 eye = texels_from_local[3].xy;
  vec2 inside = intersect(slab(eye.x, direction.x, 0.0, map_size.x), slab(eye.y, direction.y, 0.0, map_size.y));
  inside.x = max(inside.x, 0.0);
  slice = vec4(direction, 0.0, 0.0);
  if (inside.y <= inside.x) return;
  // Cells begin where the line crosses from texel to texel along its axis.
  bool along_x = abs(direction.x) >= abs(direction.y);
  float texel_part = fract(along_x ? eye.x : eye.y);
  float before = (along_x ? direction.x : direction.y) > 0.0 ? texel_part : 1.0 - texel_part;
  float first = floor(inside.x + before + 1e-4);
  slice.z = first - before;
  slice.w = max(ceil(inside.y + before - 1e-4) - first, 0.0);
}
