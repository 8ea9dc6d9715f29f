#version 310 es
#pragma skyshaft large_primitives
// A shaft picture in square cells, with what of its light varies so slowly that the cells' corners tell it: the sky's,
// scattered towards the eye. Row 0 of the picture is row 0 of the viewport.
#include "lib/quad.glsl"
#include "shafts/sky_scattered.glsl"

uniform int columns;             // of cells
uniform float cell_px;
uniform vec2 half_size_px;       // of the picture
uniform vec2 view_px_per_px;     // as ray.glsl has it

out vec3 sky_light;

void main() {
  int cell = gl_VertexID / 6;
  ivec2 corner = quad_corner(gl_VertexID);
  vec2 px = vec2(float(cell % columns + corner.x), float(cell / columns + corner.y)) * cell_px;
  gl_Position = vec4(px / half_size_px - 1.0, 0.0, 1.0);
  sky_light = sky_scattered(normalize(local_ray_from_px * vec3(px * view_px_per_px, 1.0)));
}
