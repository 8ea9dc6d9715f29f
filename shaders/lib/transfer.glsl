// Transfer functions between coded (non-linear, 0 to 1) and linear light (1 is white). Each pair is exactly inverse and
// continued as an odd function below zero and past one, so that out-of-gamut codes survive a round trip.
// Pure functions, also compiled as C++ by render/composite/picture_math.cpp.

// Rec. ITU-R BT.709-6 item 1.2, with the unrounded constants of BT.2020-2 table 4 for which both branches meet
// smoothly: alpha = 1 + 5.5 beta, alpha - 1 + 4.5 beta = alpha beta^0.45.
const float kBt709Alpha = 1.09929682680944f;
const float kBt709Beta = 0.018053968510807f;

vec3 bt709_linear_from_coded(vec3 coded) {
  vec3 v = abs(coded);
  vec3 high = pow((v + (kBt709Alpha - 1.0f)) * (1.0f / kBt709Alpha), vec3(1.0f / 0.45f));
  return sign(coded) * mix(high, v * (1.0f / 4.5f), lessThan(v, vec3(4.5f * kBt709Beta)));
}

vec3 bt709_coded_from_linear(vec3 linear) {
  vec3 v = abs(linear);
  vec3 high = kBt709Alpha * pow(v, vec3(0.45f)) - (kBt709Alpha - 1.0f);
  return sign(linear) * mix(high, v * 4.5f, lessThan(v, vec3(kBt709Beta)));
}

// IEC 61966-2-1 (sRGB), equations of its clause 5.2.
vec3 srgb_linear_from_coded(vec3 coded) {
  vec3 v = abs(coded);
  vec3 high = pow((v + 0.055f) * (1.0f / 1.055f), vec3(2.4f));
  return sign(coded) * mix(high, v * (1.0f / 12.92f), lessThan(v, vec3(0.04045f)));
}

vec3 srgb_coded_from_linear(vec3 linear) {
  vec3 v = abs(linear);
  vec3 high = 1.055f * pow(v, vec3(1.0f / 2.4f)) - 0.055f;
  return sign(linear) * mix(high, v * 12.92f, lessThan(v, vec3(0.0031308f)));
}

// Pure power, as BT.470 system M (2.2) and B, G (2.8) assume.
vec3 gamma_linear_from_coded(vec3 coded, float gamma) { return sign(coded) * pow(abs(coded), vec3(gamma)); }
vec3 gamma_coded_from_linear(vec3 linear, float gamma) { return sign(linear) * pow(abs(linear), vec3(1.0f / gamma)); }
