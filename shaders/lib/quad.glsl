// The corner of a rectangle that a vertex of its two triangles is: x and y 0 or 1. Six vertices to a rectangle.
ivec2 quad_corner(int vertex) {
  int corner = vertex % 6;  // 0 1 2, 2 1 3
  corner = corner < 3 ? corner : corner == 3 ? 2 : corner == 4 ? 1 : 3;
  return ivec2(corner & 1, corner >> 1);
}
