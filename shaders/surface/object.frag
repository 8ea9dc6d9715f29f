#version 310 es
// A virtual surface, shaded where it is drawn.
precision highp float;
precision highp int;

#include "surface/shading.glsl"

layout(location = 0) out vec4 added;  // a: ALPHA_BLEND: opacity; else what stays uncovered: 0
#ifdef MARKED
#include "surface/surface_mark.glsl"
layout(location = 1) out float mark;  // surface_mark()
#endif

void main() {
  vec4 light = shade();
#ifdef ALPHA_BLEND
  added = vec4(light.rgb * light.a, light.a);  // premultiplied
#else
  added = vec4(light.rgb, 0.0);
#endif
#ifdef MARKED
  mark = surface_mark(gl_FragCoord.z, surface_normal());
#endif
}
