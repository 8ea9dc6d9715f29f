#version 310 es
// A virtual surface, shaded where it is drawn.
// variant: VIRTUAL_CASTERS BLOCKER_TAPS=4 FILTER_TAPS=8
// variant: FACING_CODE VIRTUAL_CASTERS REAL_CASTERS BLOCKER_TAPS=4 FILTER_TAPS=8 BASE_COLOR_TEXTURE METALLIC_ROUGHNESS_TEXTURE NORMAL_TEXTURE OCCLUSION_TEXTURE EMISSIVE_TEXTURE THIN
// variant: ALPHA_BLEND BASE_COLOR_TEXTURE BLOCKER_TAPS=4 FILTER_TAPS=8
precision highp float;

#include "scene/facing.glsl"
#include "scene/shade.glsl"

layout(location = 0) out vec4 added;  // a: FACING_CODE: its code; ALPHA_BLEND: opacity; else what stays uncovered: 0

void main() {
  vec4 light = shade();
#ifdef FACING_CODE
  added = vec4(light.rgb, facing_code(surface_normal()));
#elif defined(ALPHA_BLEND)
  added = vec4(light.rgb * light.a, light.a);  // premultiplied
#else
  added = vec4(light.rgb, 0.0);
#endif
}
