// The epipolar lines of the picture that is drawn (render/shafts/epipolar/line_layout.h).
#include "lib/lines.glsl"

uniform vec3 sun_in_px;
uniform vec2 picture_px;
uniform vec4 side_first;
uniform vec2 rows_per_px;
uniform float last_row;
uniform float sample_px;  // from sample to sample on a line; the last one lies where the line begins

LineFan line_fan() {
  return LineFan(sun_in_px, picture_px, side_first, rows_per_px, last_row);
}
