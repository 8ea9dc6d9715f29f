// Spherical harmonics of bands 0 to 2 with the world's axes; order as in render/sky/sky_light.h.
// Constants: Ramamoorthi & Hanrahan 2001, "An efficient representation for irradiance environment maps", eq. 3.
// `direction` is a unit vector. Pure function, also compiled as C++.
vec3 sh9(vec3 c[9], vec3 direction) {
  float x = direction.x;
  float y = direction.y;
  float z = direction.z;
  return 0.282095f * c[0] + 0.488603f * (y * c[1] + z * c[2] + x * c[3]) +
         1.092548f * (x * y * c[4] + y * z * c[5] + x * z * c[7]) + 0.315392f * (3.0f * z * z - 1.0f) * c[6] +
         0.546274f * (x * x - y * y) * c[8];
}
