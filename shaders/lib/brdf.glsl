// Reflection of glTF 2.0's metallic-roughness material. `a` is alpha = roughness^2, above 0. Cosines are in [0, 1], of
// the half vector n_h and v_h, the light n_l and the eye n_v. Unit 1/sr. Pure functions, also compiled as C++.

// Microfacet distribution: Walter et al. 2007, eq. 33 (GGX). Integrates to 1 over the hemisphere when weighed by n_h.
float ggx_distribution(float n_h, float a) {
  const float pi = 3.14159265f;
  float d = 1.0f + n_h * n_h * (a * a - 1.0f);
  return a * a / (pi * d * d);
}

// Height-correlated Smith shadowing over 4 n_l n_v: Heitz 2014, eq. 99.
float smith_visibility(float n_l, float n_v, float a) {
  float a2 = a * a;
  float l = n_v * sqrt(n_l * n_l * (1.0f - a2) + a2);
  float v = n_l * sqrt(n_v * n_v * (1.0f - a2) + a2);
  return 0.5f / max(l + v, 1e-5f);
}

// Schlick 1994, eq. 15.
vec3 schlick_fresnel(vec3 f0, float v_h) {
  float m = 1.0f - v_h;
  float m2 = m * m;
  return f0 + (1.0f - f0) * (m2 * m2 * m);
}

// Part of a uniform surrounding that the specular lobe returns, [0, 1]: Karis 2014, "Physically based shading on
// mobile".
vec3 environment_brdf(vec3 f0, float roughness, float n_v) {
  const vec4 c0 = vec4(-1.0f, -0.0275f, -0.572f, 0.022f);
  const vec4 c1 = vec4(1.0f, 0.0425f, 1.04f, -0.04f);
  vec4 r = roughness * c0 + c1;
  float a004 = min(r.x * r.x, exp2(-9.28f * n_v)) * r.x + r.y;
  vec2 ab = vec2(-1.04f, 1.04f) * a004 + vec2(r.z, r.w);
  return f0 * ab.x + ab.y;
}
