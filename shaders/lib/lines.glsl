// The picture's epipolar lines (Engelhardt & Dachsbacher 2010): straight lines through the point at which the sun is
// seen, each from there, or from where it enters the picture, to the picture's border. Lines are counted by rows: their
// ends lie evenly along those borders that face away from the sun, so that every pixel is on a line wherever the sun
// is: inside, outside, behind the eye or at infinity. Places on a line are counted in pixels back from its end.
// Pure functions, also compiled as C++.

struct LineFan {
  vec3 sun_in_px;    // where the sun's direction is projected, homogeneous, z >= 0; behind the eye: negated
  vec2 picture_px;
  vec4 side_first;   // row of the first line that ends on the left, right, top, bottom border
  vec2 rows_per_px;  // along the left and right, and along the top and bottom border
  float last_row;
};

struct OnLine {
  float row;       // in between two lines
  float ahead_px;  // to the line's end
  float whole_px;  // the line's length
};

// Ways are counted in lengths of `away` until the end, which spares divisions.
OnLine on_line(LineFan fan, vec2 px) {
  vec2 away = px * fan.sun_in_px.z - vec2(fan.sun_in_px.x, fan.sun_in_px.y);  // from the sun's place: away / z pixels
  bvec2 forward = greaterThan(away, vec2(0.0f));
  vec2 inverse = 1.0f / max(abs(away), vec2(1e-20f));
  vec2 to_border = mix(px, fan.picture_px - px, forward) * inverse;
  vec2 from_border = mix(fan.picture_px - px, px, forward) * inverse;
  float ahead = min(to_border.x, to_border.y);
  float behind = min(min(from_border.x, from_border.y), 1.0f / max(fan.sun_in_px.z, 1e-20f));
  bool across = to_border.x < to_border.y;
  vec2 first = mix(vec2(fan.side_first.x, fan.side_first.z), vec2(fan.side_first.y, fan.side_first.w), forward);
  float row = across ? first.x + clamp(px.y + away.y * ahead, 0.0f, fan.picture_px.y) * fan.rows_per_px.x
                     : first.y + clamp(px.x + away.x * ahead, 0.0f, fan.picture_px.x) * fan.rows_per_px.y;
  float size = sqrt(dot(away, away));
  return OnLine(clamp(row, 0.0f, fan.last_row), ahead * size, (ahead + behind) * size);
}

struct Line {
  vec2 end;  // on the border
  vec2 back;  // unit, towards the sun
  float length_px;
};

Line line_of_row(LineFan fan, float row) {
  int side = 3;
  for (int i = 3; i > 0; --i) side = row < fan.side_first[i] ? i - 1 : side;
  float along = (row - fan.side_first[side]) / max(side < 2 ? fan.rows_per_px.x : fan.rows_per_px.y, 1e-20f);
  vec2 end = side < 2 ? vec2(side == 0 ? 0.0f : fan.picture_px.x, along)
                      : vec2(along, side == 2 ? 0.0f : fan.picture_px.y);
  vec2 away = end * fan.sun_in_px.z - vec2(fan.sun_in_px.x, fan.sun_in_px.y);
  float size = sqrt(max(dot(away, away), 1e-30f));
  vec2 direction = away / size;
  vec2 safe = mix(direction, vec2(1e-20f), lessThan(abs(direction), vec2(1e-20f)));
  vec2 from_border = abs((mix(fan.picture_px, vec2(0.0f), greaterThan(direction, vec2(0.0f))) - end) / safe);
  return Line(end, -direction, min(min(from_border.x, from_border.y), size / max(fan.sun_in_px.z, 1e-20f)));
}
