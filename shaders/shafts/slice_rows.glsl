// An epipolar slice lies across the shadow map between the centres of two rows of texels (or columns: whichever are
// nearer to its direction), and sees both, each by how near it is: what a texel's edge would put all to one side is
// shared out evenly, as percentage-closer filtering does. Who fills the rows and who weighs them must count alike, to
// the last bit.

// Places across the rows, counted from their centres, in the middles of four cells. `slice` as
// render/shafts/epipolar/slice_trees.h says.
vec4 places_across(vec2 eye_in_texels, vec4 slice, vec4 cell) {
  bool by_x = abs(slice.x) >= abs(slice.y);
  return (by_x ? eye_in_texels.y : eye_in_texels.x) + (by_x ? slice.y : slice.x) * (slice.z + cell + 0.5) - 0.5;
}
