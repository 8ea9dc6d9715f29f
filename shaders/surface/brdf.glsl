// Reflection of glTF 2.0's metallic-roughness material. `a` is alpha = roughness^2. Unit 1/sr.

const float kPi = 3.14159265;

// Microfacet distribution: Walter et al. 2007, eq. 33 (GGX).
float ggx_distribution(float n_h, float a) {
  float d = 1.0 + n_h * n_h * (a * a - 1.0);
  return a * a / (kPi * d * d);
}

// Height-correlated Smith shadowing over 4 n_l n_v: Heitz 2014, eq. 99.
float smith_visibility(float n_l, float n_v, float a) {
  float a2 = a * a;
  float l = n_v * sqrt(n_l * n_l * (1.0 - a2) + a2);
  float v = n_l * sqrt(n_v * n_v * (1.0 - a2) + a2);
  return 0.5 / max(l + v, 1e-5);
}

// Schlick 1994, eq. 15.
vec3 schlick_fresnel(vec3 f0, float v_h) {
  float m = 1.0 - v_h;
  float m2 = m * m;
  return f0 + (1.0 - f0) * (m2 * m2 * m);
}

// Part of a uniform surrounding that the specular lobe returns: Karis 2014, "Physically based shading on mobile".
vec3 environment_brdf(vec3 f0, float roughness, float n_v) {
  const vec4 c0 = vec4(-1.0, -0.0275, -0.572, 0.022);
  const vec4 c1 = vec4(1.0, 0.0425, 1.04, -0.04);
  vec4 r = roughness * c0 + c1;
  float a004 = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
  vec2 ab = vec2(-1.04, 1.04) * a004 + r.zw;
  return f0 * ab.x + ab.y;
}
