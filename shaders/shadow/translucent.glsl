// Light behind glass (render/shadow/translucent_shadow.h); SunShadow::bind_glass() sets these.
uniform highp sampler2D translucent_depth;  // of the first pane, 0 to 1; 1: none. Unfiltered
uniform sampler2D translucent_tint;
uniform mat4 translucent_map_from_local;
uniform float translucent_bias;  // in units of depth

// What panes leave of the sun's light at a place in the map.
vec3 light_behind_translucent(vec3 at) {
  // Beside the map there is no glass: its border texels are clear.
  bool behind = textureLod(translucent_depth, at.xy, 0.0).r < min(at.z - translucent_bias, 1.0);
  return behind ? textureLod(translucent_tint, at.xy, 0.0).rgb : vec3(1.0);
}

vec3 light_through_translucent(vec3 at_in_local) {
  return light_behind_translucent((translucent_map_from_local * vec4(at_in_local, 1.0)).xyz);
}
