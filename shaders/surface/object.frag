#version 310 es
// A virtual surface, shaded where it is drawn.
// variant: VIRTUAL_OCCLUDERS BLOCKER_TAPS=4 FILTER_TAPS=8
// variant: MARKED VIRTUAL_OCCLUDERS REAL_OCCLUDERS BLOCKER_TAPS=4 FILTER_TAPS=8 BASE_COLOR_TEXTURE METALLIC_ROUGHNESS_TEXTURE NORMAL_TEXTURE OCCLUSION_TEXTURE EMISSIVE_TEXTURE THIN
// variant: VIRTUAL_OCCLUDERS TRANSLUCENT BLOCKER_TAPS=4 FILTER_TAPS=8
// variant: ALPHA_BLEND BASE_COLOR_TEXTURE BLOCKER_TAPS=4 FILTER_TAPS=8
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
