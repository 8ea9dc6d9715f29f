// The highlight shoulder: what display-linear light becomes before it is encoded. Identity below the knee, then a
// hyperbola that reaches picture white (1) at kShoulderWhite with a first derivative that is continuous everywhere,
// then its tangent. Monotonic and invertible for all values: the real picture enters linear light through the inverse,
// so that it leaves unchanged where nothing was added, and added light rolls off instead of clipping. Pure functions,
// also compiled as C++ by render/composite/picture_math.cpp.

const float kShoulderKnee = 0.75f;
const float kShoulderWhite = 1.5f;  // a half stop above white: a shadow on white paper stays a shadow
// y = t / (1 + t / s) with t past the knee meets (white - knee, 1 - knee).
const float kShoulderScale = 1.0f / (1.0f / (1.0f - kShoulderKnee) - 1.0f / (kShoulderWhite - kShoulderKnee));
const float kShoulderWhiteRatio = 1.0f + (kShoulderWhite - kShoulderKnee) / kShoulderScale;
const float kShoulderWhiteSlope = 1.0f / (kShoulderWhiteRatio * kShoulderWhiteRatio);

vec3 shoulder(vec3 linear) {
  vec3 t = clamp(linear - kShoulderKnee, vec3(0.0f), vec3(kShoulderWhite - kShoulderKnee));
  vec3 past_white = max(linear - kShoulderWhite, vec3(0.0f));
  return min(linear, vec3(kShoulderKnee)) + t / (1.0f + t * (1.0f / kShoulderScale)) + past_white * kShoulderWhiteSlope;
}

vec3 shoulder_inverse(vec3 shown) {
  vec3 y = clamp(shown - kShoulderKnee, vec3(0.0f), vec3(1.0f - kShoulderKnee));
  vec3 past_white = max(shown - 1.0f, vec3(0.0f));
  return min(shown, vec3(kShoulderKnee)) + y / (1.0f - y * (1.0f / kShoulderScale)) +
         past_white * (1.0f / kShoulderWhiteSlope);
}
