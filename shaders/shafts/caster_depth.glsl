// The map of the first casters that rays are marched against (render/shafts/caster_map.h). Needs shafts/ray.glsl.
uniform highp sampler2D caster_depth;
uniform mat4 map_from_local;  // (u, v, depth): u and v 0 to 1 inside
uniform float end_margin_m;   // the map tells no surface from the air this close to it
uniform float end_margin;     // nor the epipolar lines, for each metre from the eye

// Where a ray is in the prism behind the map's near plane: there, casters may shade it.
vec2 shadow_stretch(vec3 direction) {
  vec3 origin = map_from_local[3].xyz;
  vec3 d = mat3(map_from_local) * direction;
  return intersect(intersect(slab(origin.x, d.x, 0.0, 1.0), slab(origin.y, d.y, 0.0, 1.0)),
                   slab(origin.z, d.z, 0.0, 1e20));
}

// What of a part of the medium's stretch is to be marched: where casters may shade it and it is seen. It ends before
// the surface at which the ray does, since texels of the map straddle surfaces; of a part that is no farther from
// there, what comes right before tells. `shadow`: that of its ray.
vec2 marched_stretch(vec2 shadow, Air air, vec2 stretch, vec2 part) {
  vec2 shaded = intersect(shadow, vec2(part.x, min(part.y, way_of_depth(air, kDeepest))));
  float last = stretch.y * (1.0 - end_margin) - end_margin_m;
#ifdef PARTED
  last = max(last, mix(max(shadow.x, stretch.x), stretch.y, 0.5));
  bool to_surface = shaded.y > last && shadow.y >= stretch.y && part.y > part.x;
  if (to_surface) shaded = vec2(min(shaded.x, last * (1.0 - 1e-4)), last);
#else
  if (shaded.y == stretch.y) shaded.y = max(last, mix(shaded.x, shaded.y, 0.5));
#endif
  return shaded;
}

// Of `all` sunlight of the stretch, what there is when that part of the light from where marching begins to its reach
// is lit: to where the surface is or the casters' shade ends. What lies behind the marched stretch is as lit as its
// end.
float sunlight_when(float lit, Air air, vec2 stretch, vec2 marched, float reach, float all) {
  if (marched.y <= marched.x) return all;
  float part = marched.x == stretch.x && reach == stretch.y ? all : sunlight_of(air, vec2(marched.x, reach));
  return max(all - min(part, all) * (1.0 - lit), 0.0);
}

// `at` in texels across the map; a texel without a caster holds 1 or more. Marched stretches lie inside the map, but
// rounding may step over its edge: a fetch beyond it is 0, which must not count as shade.
float lit_at(vec3 at, ivec2 last) {
  return texelFetch(caster_depth, clamp(ivec2(at.xy), ivec2(0), last), 0).r < min(at.z, 1.0) ? 0.0 : 1.0;
}

// The same of the four texels around `at` (u and v 0 to 1 across the map), each by how near it is: percentage-closer
// filtering (Reeves et al. 1987).
float filtered_lit_at(vec3 at) {
  vec2 size = vec2(textureSize(caster_depth, 0));
  vec2 place = at.xy * size - 0.5;
  vec2 first = floor(place);
  vec2 part = place - first;
  vec4 depth = textureGather(caster_depth, (first + 1.0) / size, 0);  // of (0, 1), (1, 1), (1, 0), (0, 0)
  vec4 lit = vec4(greaterThanEqual(depth, vec4(min(at.z, 1.0))));
  return mix(mix(lit.w, lit.z, part.x), mix(lit.x, lit.y, part.x), part.y);
}
