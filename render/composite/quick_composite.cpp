#include "render/composite/quick_composite.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <thread>

#include "render/composite/code_tables.h"
#include "render/composite/composite_pass.h"
#include "render/composite/picture_math.h"
#include "render/composite/planes.h"

namespace render {
namespace {

using quick::Bytes8;
using quick::columns;
using quick::floats;
using quick::Floats4;
using quick::higher;
using quick::Ints4;
using quick::kDitherSize;
using quick::lower;
using quick::Tables;
using quick::Words8;

// Where a pixel looks in the merged picture: which is the upper left of the four pixels around it (bits 8 and up), and
// the way from there to the right (bits 4 to 7) and down, in sixteenths.
using Spot = std::uint32_t;
constexpr Spot kNowhere = 0xFFFFFFFFU;
constexpr int kSpotStep = 16;

Words8 load(const MergedPixel& pixel) {
  Bytes8 bytes;
  std::memcpy(&bytes, &pixel, sizeof bytes);
  return __builtin_convertvector(bytes, Words8);
}

Floats4 low_floats(Words8 words) {
  return __builtin_convertvector(
      std::bit_cast<Ints4>(__builtin_shufflevector(words, Words8{}, 0, 8, 1, 9, 2, 10, 3, 11)), Floats4);
}
Floats4 high_floats(Words8 words) {
  return __builtin_convertvector(
      std::bit_cast<Ints4>(__builtin_shufflevector(words, Words8{}, 4, 8, 5, 9, 6, 10, 7, 11)), Floats4);
}

// Whether anything is laid over a pixel that looks between this pixel, the next and those below.
void note_touched(const MergedPicture& merged, std::vector<std::uint8_t>& touched) {
  const auto is_touched = [](const MergedPixel& pixel) {
    return std::bit_cast<std::uint64_t>(pixel) != std::bit_cast<std::uint64_t>(MergedPixel{});
  };
  const auto width = static_cast<std::size_t>(merged.width);
  touched.assign(merged.pixels.size(), 0);
  for (std::size_t i = merged.pixels.size(); i-- > 0;) {
    const bool here = is_touched(merged.pixels[i]);
    if (!here) continue;
    touched[i] = 1;
    if (i >= 1) touched[i - 1] = 1;
    if (i >= width) touched[i - width] = 1;
    if (i >= width + 1) touched[i - width - 1] = 1;
  }
}

// What decides Spot of every pixel.
struct SpotsKey {
  std::shared_ptr<const LensMap> lens;
  int width = 0;
  int height = 0;
  int merged_width = 0;
  int merged_height = 0;
  bool operator==(const SpotsKey&) const = default;
};

int spot_along(double texel, int size) {
  return static_cast<int>(std::clamp(texel, 0.0, size - 1 - 1.0 / kSpotStep) * kSpotStep);
}

Spot spot_at(const glm::dvec2& texel, const View& view) {
  const int x = spot_along(texel.x, view.width);
  const int y = spot_along(texel.y, view.height);
  const int index = y / kSpotStep * view.width + x / kSpotStep;
  return static_cast<Spot>(index) << 8 | static_cast<Spot>(x % kSpotStep) << 4 | static_cast<Spot>(y % kSpotStep);
}

std::vector<Spot> make_spots(const Camera& camera, const View& view) {
  std::vector<Spot> spots;
  spots.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      glm::dvec2 at((x + 0.5) * view.width / camera.width, (y + 0.5) * view.height / camera.height);
      if (camera.lens) at = glm::dvec2(camera.lens->ideal[spots.size()]) * view.focal_px + view.centre_px;
      const bool inside = at.x >= 0.0 && at.y >= 0.0 && at.x <= view.width && at.y <= view.height;
      spots.push_back(inside ? spot_at(at - 0.5, view) : kNowhere);
    }
  }
  return spots;
}

// What all rows of blocks need.
struct Job {
  const Tables& tables;
  const std::vector<Spot>& spots;
  const std::vector<std::uint8_t>& touched;
  const MergedPicture& merged;
  const PictureView& in;
  const MutablePictureView& out;
  std::array<Floats4, 3> rgb_from_code;  // columns
  Floats4 rgb_offset;
  std::array<Floats4, 3> code_from_rgb;
  Floats4 code_offset;
  float code_min;
  float code_max;

  bool is_touched(Spot spot) const { return spot != kNowhere && touched[spot >> 8] != 0; }
  [[gnu::always_inline]] inline Floats4 composite(Spot spot, float luma, Floats4 coded_chroma) const;
  template <typename Sample>
  void block_row(int row) const;
  template <typename Sample>
  [[gnu::always_inline]] inline void block(int column, int row) const;
};

// The code of a pixel with that luma, where the block's chroma makes coded_chroma of its coded RGB.
Floats4 Job::composite(Spot spot, float luma, Floats4 coded_chroma) const {
  const MergedPixel* upper = merged.pixels.data() + (spot >> 8);
  const MergedPixel* below = upper + merged.width;
  const auto right = static_cast<std::uint16_t>(spot >> 4 & 15U);
  const auto down = static_cast<std::uint16_t>(spot & 15U);
  const auto left = static_cast<std::uint16_t>(kSpotStep - right);
  const auto up = static_cast<std::uint16_t>(kSpotStep - down);
  const Words8 sum =
      (load(upper[0]) * left + load(upper[1]) * right) * up + (load(below[0]) * left + load(below[1]) * right) * down;
  constexpr float kOne = 1.0F / (255 * kSpotStep * kSpotStep);
  const Floats4 keep = low_floats(sum) * kOne;
  const Floats4 root = high_floats(sum) * kOne;
  const Floats4 shown = luma * rgb_from_code[0] + coded_chroma;
  const Floats4 made = tables.coded(tables.linear(shown) * keep + root * root * kMergedWhite);
  // Only what the source itself holds beyond white may go beyond white.
  const Floats4 coded = lower(made, higher(shown, Floats4{} + 1.0F));
  return coded[0] * code_from_rgb[0] + coded[1] * code_from_rgb[1] + coded[2] * code_from_rgb[2] + code_offset;
}

// One chroma sample and the pixels that it belongs to. A pixel's chroma is taken as its block's; the block's changes by
// the mean of its pixels' changes.
template <typename Sample>
void Job::block(int column, int row) const {
  const glm::ivec2 shift = chroma_shift(in.format.chroma);
  const auto sample = [](const auto& picture, std::size_t plane, int x, int y) {
    return reinterpret_cast<const Sample*>(picture.plane[plane] + y * picture.stride_bytes[plane]) + x;
  };
  const auto writable = [this](std::size_t plane, int x, int y) {
    return reinterpret_cast<Sample*>(out.plane[plane] + y * out.stride_bytes[plane]) + x;
  };
  const auto rounded = [this](float code) { return static_cast<Sample>(std::clamp(code + 0.5F, code_min, code_max)); };
  const auto dither = [this](int x, int y) {
    return tables.dither[static_cast<std::size_t>((y % kDitherSize) * kDitherSize + x % kDitherSize)];
  };
  const float cb = *sample(in, 1, column, row);
  const float cr = *sample(in, 2, column, row);
  const Floats4 coded_chroma = cb * rgb_from_code[1] + cr * rgb_from_code[2] + rgb_offset;
  const int x_end = std::min((column + 1) << shift.x, in.format.width);
  const int y_end = std::min((row + 1) << shift.y, in.format.height);
  Floats4 change{};
  int pixels = 0;
  int changed = 0;
  for (int y = row << shift.y; y < y_end; ++y) {
    const Spot* spot = spots.data() + std::ptrdiff_t{y} * in.format.width;
    for (int x = column << shift.x; x < x_end; ++x, ++pixels) {
      if (!is_touched(spot[x])) continue;
      const Floats4 code = composite(spot[x], *sample(in, 0, x, y), coded_chroma);
      *writable(0, x, y) = rounded(code[0] + dither(x, y));
      change += code;
      ++changed;
    }
  }
  if (changed == 0) return;
  const float share = 1.0F / static_cast<float>(pixels);
  const auto unchanged = static_cast<float>(pixels - changed);
  *writable(1, column, row) = rounded((change[1] + unchanged * cb) * share + dither(column + 17, row + 5));
  *writable(2, column, row) = rounded((change[2] + unchanged * cr) * share + dither(column + 5, row + 17));
}

template <typename Sample>
void Job::block_row(int row) const {
  const int columns = plane_size(in.format, 1).x;
  const Job job = *this;  // one that no sample written can change, as far as the compiler knows
  for (int column = 0; column < columns; ++column) job.block<Sample>(column, row);
}

}  // namespace

struct QuickComposite::Impl {
  int threads;
  Transfer transfer = Transfer::Bt709;
  Tables tables{Transfer::Bt709};
  SpotsKey key;
  std::vector<Spot> spots;
  std::vector<std::uint8_t> touched;
};

QuickComposite::QuickComposite(int threads)
    : impl_(new Impl{.threads = std::max(1, threads), .key = {}, .spots = {}, .touched = {}}) {}
QuickComposite::~QuickComposite() = default;

void QuickComposite::draw(const Camera& camera, const View& view, const MergedPicture& merged, const PictureView& in,
                          const MutablePictureView& out) {
  check_format(in.format);
  Impl& impl = *impl_;
  if (impl.transfer != in.format.transfer) {
    impl.tables = Tables(in.format.transfer);
    impl.transfer = in.format.transfer;
  }
  const SpotsKey key{camera.lens, camera.width, camera.height, merged.width, merged.height};
  if (impl.key != key) {
    impl.spots = make_spots(camera, view);
    impl.key = key;
  }
  copy_picture(in, out);
  note_touched(merged, impl.touched);
  const CodeTransform decode = rgb_from_code(in.format);
  const CodeTransform encode = code_from_rgb(in.format);
  const CodeLimits limits = code_limits(in.format);
  const Job job{.tables = impl.tables,
                .spots = impl.spots,
                .touched = impl.touched,
                .merged = merged,
                .in = in,
                .out = out,
                .rgb_from_code = columns(decode.matrix),
                .rgb_offset = floats(decode.offset),
                .code_from_rgb = columns(encode.matrix),
                .code_offset = floats(encode.offset),
                .code_min = static_cast<float>(limits.min),
                .code_max = static_cast<float>(limits.max)};
  const int rows = plane_size(in.format, 1).y;
  const auto work = [&](int first) {
    for (int row = first; row < rows; row += impl.threads) {
      in.format.bit_depth > 8 ? job.block_row<std::uint16_t>(row) : job.block_row<std::uint8_t>(row);
    }
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < impl.threads; ++i) helpers.emplace_back(work, i);
  work(0);
}

}  // namespace render
