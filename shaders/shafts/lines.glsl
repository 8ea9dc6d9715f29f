// The picture's epipolar lines (Engelhardt & Dachsbacher 2010): straight lines through the point at which the sun is
// seen, each from there, or from where it enters the picture, to the picture's border. Lines are counted by rows: their
// ends lie evenly along those borders that face away from the sun, so that every pixel is on a line wherever the sun
// is: inside, outside, behind the eye or at infinity.
uniform vec3 sun_in_px;     // where the sun's direction is projected, homogeneous; z < 0: behind the eye
uniform vec2 picture_px;
uniform ivec4 side_first;   // row of the first line that ends on the left, right, top, bottom border
uniform ivec4 side_count;   // and how many do; both corners are among them. 0: none end there

// Direction away from the sun's place, of a length that tells how far that is: sun's place = px - away / |sun_in_px.z|.
vec2 away_from_sun(vec2 px) {
  vec2 away = px * sun_in_px.z - sun_in_px.xy;
  return sun_in_px.z < 0.0 ? -away : away;
}

// How many times `direction` leads from inside to the borders across x and y.
vec2 to_borders(vec2 px, vec2 direction) {
  vec2 border = mix(vec2(0.0), picture_px, greaterThan(direction, vec2(0.0)));
  vec2 safe = mix(direction, vec2(1e-20), lessThan(abs(direction), vec2(1e-20)));
  return max(abs((border - px) / safe), vec2(0.0));
}

// From px back towards the sun, in units of away_from_sun() divided by `scale`, to where the line begins.
float to_start(vec2 px, vec2 direction, float scale) {
  vec2 border = to_borders(px, -direction);
  return min(min(border.x, border.y), scale / max(abs(sun_in_px.z), 1e-20));
}

struct Line {
  vec2 start;
  vec2 end;  // on the border
};

Line line_of_row(int row) {
  int side = row >= side_first.w && side_count.w > 0 ? 3 : row >= side_first.z && side_count.z > 0 ? 2
           : row >= side_first.y && side_count.y > 0 ? 1 : 0;
  float part = clamp(float(row - side_first[side]) / float(max(side_count[side] - 1, 1)), 0.0, 1.0);
  Line line;
  line.end = side == 0 ? vec2(0.0, part * picture_px.y) : side == 1 ? vec2(picture_px.x, part * picture_px.y)
           : side == 2 ? vec2(part * picture_px.x, 0.0) : vec2(part * picture_px.x, picture_px.y);
  vec2 away = away_from_sun(line.end);
  float scale = max(max(abs(away.x), abs(away.y)), 1e-20);
  vec2 direction = away / scale;
  line.start = line.end - direction * to_start(line.end, direction, scale);
  return line;
}

// x: row, in between two lines. y: place along the line, 0 at its start to 1 at its end.
vec2 row_and_place(vec2 px) {
  vec2 away = away_from_sun(px);
  float scale = max(max(abs(away.x), abs(away.y)), 1e-20);
  vec2 direction = away / scale;
  vec2 border = to_borders(px, direction);
  bool across = border.x < border.y;
  float ahead = min(border.x, border.y);
  vec2 end = px + direction * ahead;
  float behind = to_start(px, direction, scale);
  int side = across ? (direction.x > 0.0 ? 1 : 0) : (direction.y > 0.0 ? 3 : 2);
  float part = across ? end.y / picture_px.y : end.x / picture_px.x;
  float row = float(side_first[side]) + clamp(part, 0.0, 1.0) * float(side_count[side] - 1);
  return vec2(row, behind / max(behind + ahead, 1e-20));
}
