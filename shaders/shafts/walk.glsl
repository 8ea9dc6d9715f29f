// A ray's way through the min-max tree of its epipolar slice: stretches that lie before all casters of a node, or behind
// them all, are taken whole, and cells are cut exactly where the ray meets the depth of their caster. Needs ray.glsl.
precision highp int;

uniform highp sampler2D slices;    // slice.frag
uniform highp usampler2D leaves;   // leaves.frag
uniform highp usampler2D nodes;    // nodes.frag
uniform ivec4 level_first;
uniform int top_level;
uniform mat4 texels_from_local;

// Part of the stretch's sunlight that gets past the casters, as the slice of that row sees them; 1 for an empty one.
float walk(int row, Ray ray, Air air, vec2 stretch) {
  vec4 slice = texelFetch(slices, ivec2(0, row), 0);
  vec3 along = mat3(texels_from_local) * ray.direction;
  float texels_per_m = abs(slice.x) >= abs(slice.y) ? abs(along.x) : abs(along.y);
  float m_per_texel = 1.0 / max(texels_per_m, 1e-12);
  float eye_depth = texels_from_local[3].z;
  float slope = abs(along.z) < 1e-12 ? 1e-12 : along.z;
  float inverse_slope = 1.0 / slope;
  int cells = int(slice.w);

  float t = stretch.x;
  float to = min(stretch.y, (slice.z + slice.w) * m_per_texel);
  vec2 depths = depths_to(air, t);
  float all = 0.0;
  float dark = 0.0;
  float first_t = slice.z * m_per_texel;
  if (t < first_t && cells > 0) {  // not yet over the map
    t = min(first_t, stretch.y);
    vec2 next = depths_to(air, t);
    all = sunlight_between(depths, next);
    depths = next;
  }
  int cell = clamp(int(floor(t * texels_per_m - slice.z)), 0, max(cells - 1, 0));
  int level = top_level;
  while (t < to && cell < cells) {
    while (level >= 0 && t < to && cell < cells) {
      int shift = 4 + 2 * level;
      int node = cell >> shift;
      float end = min((slice.z + float((node + 1) << shift)) * m_per_texel, to);
      uvec2 found = texelFetch(nodes, ivec2(level_first[level] + node, row), 0).xy;
      vec2 bounds = vec2(ivec2(found));
      float from_depth = eye_depth + slope * t;
      float to_depth = eye_depth + slope * end;
      bool lit = max(from_depth, to_depth) <= bounds.x;
      bool shaded = min(from_depth, to_depth) > bounds.y;
      if (lit || shaded) {
        vec2 next = depths_to(air, end);
        float part = sunlight_between(depths, next);
        all += part;
        dark += shaded ? part : 0.0;
        depths = next;
        t = max(t, end);
        cell = (node + 1) << shift;
        level = (node & 3) == 3 ? min(level + 1, top_level) : level;
      } else {
        level -= 1;
      }
    }
    // Four cells at a time, where a node of sixteen is neither lit nor shaded as a whole.
    bool open = level < 0 && t < to && cell < cells;
    int four = cell >> 2;
    float end = min((slice.z + float(four * 4 + 4)) * m_per_texel, to);
    vec4 caster = vec4(ivec4(texelFetch(leaves, ivec2(four, row), 0)));
    vec4 begin = (slice.z + float(four * 4) + vec4(0.0, 1.0, 2.0, 3.0)) * m_per_texel;
    vec4 finish = clamp(begin + m_per_texel, t, to);
    begin = clamp(begin, t, to);
    // A ray that goes down the light is shaded behind the caster's depth, one that goes up is before it.
    vec4 meeting = (caster - eye_depth) * inverse_slope;
    begin = slope > 0.0 ? max(begin, meeting) : begin;
    finish = slope > 0.0 ? finish : min(finish, meeting);
    vec4 shaded = max(finish - begin, vec4(0.0));
    vec2 next = depths_to(air, end);
    float part = sunlight_between(depths, next);
    float dark_part = part * min(dot(shaded, vec4(1.0)) / max(end - t, 1e-20), 1.0);
    // Cells are long on rays that run along the light; the light then fades within one.
    int count = open && next.x - depths.x > 0.01 ? 4 : 0;
    if (count > 0) dark_part = 0.0;
    for (int i = 0; i < count; ++i) dark_part += sunlight_of(air, vec2(begin[i], finish[i]));
    if (open) {
      all += part;
      dark += min(dark_part, part);
      depths = next;
      t = max(t, end);
      cell = four * 4 + 4;
      level = (four & 3) == 3 ? 0 : -1;
    }
  }
  if (t < stretch.y) all += sunlight_between(depths, depths_to(air, stretch.y));  // beyond the map
  return all > 0.0 ? clamp(1.0 - dark / all, 0.0, 1.0) : 1.0;
}
