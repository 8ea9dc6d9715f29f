#pragma once

namespace render {

// What a video sample means. Unknown is a value, for streams that do not say: ar::guess_color() is the one place that
// replaces it, and a picture that is drawn on has none.
// `Rgb` is planar G, B, R (FFmpeg's gbrp order) with no matrix.
enum class ColorMatrix { Unknown, Rgb, Bt601, Bt709, Bt2020 };
enum class ColorRange { Unknown, Limited, Full };
// Decoded with the inverse of the tagged OETF (so that linear light is scene-like). Bt709 also serves BT.601 and
// BT.2020 SDR. Pq and Hlg are tone-mapped to SDR before they are drawn on.
enum class Transfer { Unknown, Bt709, Srgb, Linear, Gamma22, Gamma28, Pq, Hlg };
enum class Chroma { C420, C422, C444 };
enum class ChromaSiting { Unknown, Left, Center, TopLeft };

}  // namespace render
