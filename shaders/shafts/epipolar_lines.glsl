// The picture's epipolar lines (Engelhardt & Dachsbacher 2010): straight lines through the point at which the sun is
// seen, each from there, or from where it enters the picture, to the picture's border. Lines are counted by rows: their
// ends lie evenly along those borders that face away from the sun, so that every pixel is on a line wherever the sun
// is: inside, outside, behind the eye or at infinity. Places on a line are counted in pixels back from its end.
uniform vec3 sun_in_px;        // where the sun's direction is projected, homogeneous, z >= 0; behind the eye: negated
uniform vec2 picture_px;
uniform vec4 side_first;       // row of the first line that ends on the left, right, top, bottom border
uniform vec2 rows_per_px;      // along the left and right, and along the top and bottom border
uniform float last_row;
uniform float sample_px;       // from sample to sample on a line; the last one lies where the line begins

struct OnLine {
  float row;       // in between two lines
  float ahead_px;  // to the line's end
  float whole_px;  // the line's length
};

// Ways are counted in lengths of `away` until the end, which spares divisions.
OnLine on_line(vec2 px) {
  vec2 away = px * sun_in_px.z - sun_in_px.xy;  // from the sun's place: away / sun_in_px.z pixels
  bvec2 forward = greaterThan(away, vec2(0.0));
  vec2 inverse = 1.0 / max(abs(away), vec2(1e-20));
  vec2 to_border = mix(px, picture_px - px, forward) * inverse;
  vec2 from_border = mix(picture_px - px, px, forward) * inverse;
  float ahead = min(to_border.x, to_border.y);
  float behind = min(min(from_border.x, from_border.y), 1.0 / max(sun_in_px.z, 1e-20));
  bool across = to_border.x < to_border.y;
  vec2 first = mix(side_first.xz, side_first.yw, forward);
  float row = across ? first.x + clamp(px.y + away.y * ahead, 0.0, picture_px.y) * rows_per_px.x
                     : first.y + clamp(px.x + away.x * ahead, 0.0, picture_px.x) * rows_per_px.y;
  float size = sqrt(dot(away, away));
  return OnLine(clamp(row, 0.0, last_row), ahead * size, (ahead + behind) * size);
}

struct Line {
  vec2 end;  // on the border
  vec2 back;  // unit, towards the sun
  float length_px;
};

Line line_of_row(float row) {
  int side = 3;
  for (int i = 3; i > 0; --i) side = row < side_first[i] ? i - 1 : side;
  float along = (row - side_first[side]) / max(side < 2 ? rows_per_px.x : rows_per_px.y, 1e-20);
  vec2 end = side < 2 ? vec2(side == 0 ? 0.0 : picture_px.x, along) : vec2(along, side == 2 ? 0.0 : picture_px.y);
  vec2 away = end * sun_in_px.z - sun_in_px.xy;
  float size = sqrt(max(dot(away, away), 1e-30));
  vec2 direction = away / size;
  vec2 safe = mix(direction, vec2(1e-20), lessThan(abs(direction), vec2(1e-20)));
  vec2 from_border = abs((mix(picture_px, vec2(0.0), greaterThan(direction, vec2(0.0))) - end) / safe);
  return Line(end, -direction, min(min(from_border.x, from_border.y), size / max(sun_in_px.z, 1e-20)));
}
