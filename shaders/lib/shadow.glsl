// Where a shadow map's receiver is compared, and how far around it blockers are searched. Pure functions, also compiled
// as C++. Map coordinates: (u, v, depth), 0 to 1 inside the map, depth along the light's travel
// (render/shadow/sun_shadow.h).

struct ShadowMap {
  mat4 map_from_local;
  mat3 local_from_map;
  vec3 metres_per_unit;  // size of the map along u, v, depth
  float texel;           // 1 / map size
  float reach;           // of the map's bounds, in map units to either side
  float layer;           // of the depth arrays
};

// What the receiver's own plane does to depth across the map: d depth / d (u, v), from its normal, unit and facing the
// light. Each column of local_from_map is one map unit in metres. Isidoro 2006, "Shadow mapping: GPU-based tips and
// techniques": receiver plane depth bias, here from the known normal instead of screen derivatives, so that it is exact
// on edges too. A plane that the light grazes has an unbounded slope; such a plane receives next to no light, so it is
// capped at 200.
vec2 receiver_slope(mat3 local_from_map, vec3 normal_in_local) {
  vec3 n = transpose(local_from_map) * normal_in_local;
  float facing = min(n.z, -0.02f * length(local_from_map[2]));
  return clamp(-vec2(n.x, n.y) / facing, vec2(-200.0f), vec2(200.0f));
}

// Fixed points spread evenly over the unit disc: Vogel 1979, "A better way to construct the sunflower head". Each turns
// the last one's direction by the golden angle; software rasterisers have no quick sine.
vec2 next_direction(vec2 direction) {
  return mat2(-0.7373689f, 0.6754903f, -0.6754903f, -0.7373689f) * direction;
}

// Depth that a receiver is compared by. Texels hold the depth at their centres, up to one texel from the point of a
// bilinear comparison; half a millimetre is rounding.
float biased_receiver(ShadowMap map, float depth, vec2 slope) {
  return depth - (abs(slope.x) + abs(slope.y)) * map.texel - 0.0005f / map.metres_per_unit.z;
}

// Radius, in map units, of a penumbra whose blocker is `gap` (of the map's depth) up the light: the gap in metres times
// the tangent of the sun's angular radius.
vec2 penumbra_radius(ShadowMap map, float gap, float disc_slope) {
  return disc_slope * gap * map.metres_per_unit.z / vec2(map.metres_per_unit.x, map.metres_per_unit.y);
}
