// Spherical harmonics of bands 0 to 2 with the world's axes; order as in render/sky/sky_light.h.
// Constants: Ramamoorthi & Hanrahan 2001, "An efficient representation for irradiance environment maps", eq. 3.
// `direction` is a unit vector.
vec3 sh9(vec3 c[9], vec3 direction) {
  float x = direction.x;
  float y = direction.y;
  float z = direction.z;
  return 0.282095 * c[0] + 0.488603 * (y * c[1] + z * c[2] + x * c[3]) +
         1.092548 * (x * y * c[4] + y * z * c[5] + x * z * c[7]) + 0.315392 * (3.0 * z * z - 1.0) * c[6] +
         0.546274 * (x * x - y * y) * c[8];
}
