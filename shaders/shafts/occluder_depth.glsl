// The map of the first occluders that rays are marched against (render/shafts/occluder_map.h). Needs shafts/ray.glsl.
uniform highp sampler2DArray occluder_depth;
uniform int occluder_layer;  // of it
uniform mat4 map_from_local;  // (u, v, depth): u and v 0 to 1 inside
uniform float end_margin_m;   // the map tells no surface from the medium this close to it
uniform float end_margin;     // nor the epipolar lines, for each metre from the eye

// Where a ray is in the prism behind the map's near plane: there, occluders may shadow it.
vec2 shadow_segment(vec3 direction) {
  vec3 origin = map_from_local[3].xyz;
  vec3 d = mat3(map_from_local) * direction;
  return intersect(intersect(slab(origin.x, d.x, 0.0, 1.0), slab(origin.y, d.y, 0.0, 1.0)),
                   slab(origin.z, d.z, 0.0, 1e20));
}

// What of a part of the medium's segment is to be marched: where occluders may shadow it and it is seen. It ends before
// the surface at which the ray does, since texels of the map straddle surfaces; of a part that is no farther from
// there, what comes right before tells. `shadow`: that of its ray.
vec2 marched_segment(vec2 shadow, MediumPath path, vec2 segment, vec2 part) {
  vec2 shadowed = intersect(shadow, vec2(part.x, min(part.y, distance_at_optical_depth(path, kDeepest))));
  float last = segment.y * (1.0 - end_margin) - end_margin_m;
#ifdef CASCADE
  last = max(last, mix(max(shadow.x, segment.x), segment.y, 0.5));
  bool to_surface = shadowed.y > last && shadow.y >= segment.y && part.y > part.x;
  if (to_surface) shadowed = vec2(min(shadowed.x, last * (1.0 - 1e-4)), last);
#else
  if (shadowed.y == segment.y) shadowed.y = max(last, mix(shadowed.x, shadowed.y, 0.5));
#endif
  return shadowed;
}

// Of `all` sunlight of the segment, what there is when that part of the light from where marching begins to its reach
// is lit: to where the surface is or the occluders' shade ends. What lies behind the marched segment is as lit as its
// end.
float sunlight_when(float lit, MediumPath path, vec2 segment, vec2 marched, float reach, float all) {
  if (marched.y <= marched.x) return all;
  float part = marched.x == segment.x && reach == segment.y ? all : sunlight_of(path, vec2(marched.x, reach));
  return max(all - min(part, all) * (1.0 - lit), 0.0);
}

// `at` in texels across the map; a texel without an occluder holds 1 or more. Marched segments lie inside the map, but
// rounding may step over its edge: a fetch beyond it is 0, which must not count as shade.
float lit_at(vec3 at, ivec2 last) {
  return texelFetch(occluder_depth, ivec3(clamp(ivec2(at.xy), ivec2(0), last), occluder_layer), 0).r < min(at.z, 1.0) ? 0.0 : 1.0;
}

// The same of the four texels around `at` (u and v 0 to 1 across the map), each by how near it is: percentage-closer
// filtering (Reeves et al. 1987).
float filtered_lit_at(vec3 at) {
  vec2 size = vec2(textureSize(occluder_depth, 0).xy);
  vec2 place = at.xy * size - 0.5;
  vec2 first = floor(place);
  vec2 part = place - first;
  vec4 depth = textureGather(occluder_depth, vec3((first + 1.0) / size, float(occluder_layer)), 0);  // of (0, 1), (1, 1), (1, 0), (0, 0)
  vec4 lit = vec4(greaterThanEqual(depth, vec4(min(at.z, 1.0))));
  return mix(mix(lit.w, lit.z, part.x), mix(lit.x, lit.y, part.x), part.y);
}
