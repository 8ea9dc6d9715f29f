#pragma once

namespace render {

// What red, green and blue add to luminance: Rec. ITU-R BT.709's luma weights, which are the luminances of its
// primaries with a D65 white to four digits.
inline constexpr double kRec709Red = 0.2126;
inline constexpr double kRec709Green = 0.7152;
inline constexpr double kRec709Blue = 0.0722;

// Of linear light: its luminance (cd/m2 of luminance_rgb, lux of illuminance_rgb).
template <typename T>
constexpr T rec709_luminance(T red, T green, T blue) {
  return static_cast<T>(kRec709Red) * red + static_cast<T>(kRec709Green) * green + static_cast<T>(kRec709Blue) * blue;
}

}  // namespace render
