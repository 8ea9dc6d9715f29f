// Deterministic dither, the same for a pixel in every frame: interleaved gradient noise (Jimenez 2014, "Next generation
// post processing in Call of Duty", slide 122), in (-0.5, 0.5) steps of the output.
// Pure function, also compiled as C++ by render/composite/picture_math.cpp.

float dither(vec2 pixel) { return fract(52.9829189f * fract(dot(pixel, vec2(0.06711056f, 0.00583715f)))) - 0.5f; }
