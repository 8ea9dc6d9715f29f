// Where the steps of a march begin, metres from the eye, for 0 <= i < steps: step 0 begins where the segment does. Needs
// lib/medium_path.glsl. Pure functions, also compiled as C++.

float equal_step(int i, int steps, vec2 segment) {
  return mix(segment.x, segment.y, float(i) / float(steps));
}

// Of equal optical depths.
float step_of_equal_depth(int i, int steps, MediumPath path, vec2 segment) {
  vec2 depths = vec2(view_depth_to(path, segment.x), view_depth_to(path, segment.y));
  float depth = mix(depths.x, depths.y, float(i) / float(steps));
  return clamp(distance_at_optical_depth(path, depth), segment.x, segment.y);
}

// Tan 2020, algorithm 1: a near layer of equal steps, up to near_way_m into the segment, then steps whose length grows
// in proportion to their count. near_steps < steps.
float growing_step(int i, int steps, int near_steps, float near_way_m, vec2 segment) {
  float near = min(near_way_m, segment.y - segment.x);
  if (i < near_steps) return segment.x + near * float(i) / float(near_steps);
  float k = float(i - near_steps);
  float n = float(steps - near_steps);
  return segment.x + near + (segment.y - segment.x - near) * k * (k + 1.0f) / (n * (n + 1.0f));
}
