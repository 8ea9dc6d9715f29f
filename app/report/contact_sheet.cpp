#include "app/report/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ar/capture/color/color.h"
#include "ar/capture/file/open_source.h"
#include "ar/error.h"
#include "render/base/luminance.h"
#include "render/images/image_io.h"

namespace app {
namespace {

constexpr int kGap = 8;

// Mean of a plane's samples over a rectangle given in shares of the picture, as a fraction of the largest code.
double mean_sample(const ar::Frame& frame, std::size_t plane, double x0, double y0, double x1, double y1) {
  const bool chroma = plane > 0 && frame.format.color.matrix != ar::ColorMatrix::Rgb;
  const int width =
      chroma && frame.format.chroma != ar::Chroma::C444 ? (frame.format.width + 1) / 2 : frame.format.width;
  const int height =
      chroma && frame.format.chroma == ar::Chroma::C420 ? (frame.format.height + 1) / 2 : frame.format.height;
  const auto from_x = std::min(static_cast<int>(x0 * width), width - 1);
  const auto from_y = std::min(static_cast<int>(y0 * height), height - 1);
  const int to_x = std::clamp(static_cast<int>(std::ceil(x1 * width)), from_x + 1, width);
  const int to_y = std::clamp(static_cast<int>(std::ceil(y1 * height)), from_y + 1, height);
  double sum = 0.0;
  for (int y = from_y; y < to_y; ++y) {
    const std::uint8_t* const row = frame.plane[plane] + y * frame.stride_bytes[plane];
    for (int x = from_x; x < to_x; ++x) sum += frame.format.bit_depth == 8 ? row[x] : row[2 * x] + 256 * row[2 * x + 1];
  }
  return sum / ((to_x - from_x) * (to_y - from_y)) / ((1 << frame.format.bit_depth) - 1);
}

struct LumaWeights {
  double red, blue;
};

LumaWeights weights_of(ar::ColorMatrix matrix) {
  if (matrix == ar::ColorMatrix::Bt601) return {0.299, 0.114};
  return matrix == ar::ColorMatrix::Bt2020 ? LumaWeights{0.2627, 0.0593}
                                           : LumaWeights{render::kRec709Red, render::kRec709Blue};
}

// The frame scaled to `width`, as a screen shows it: code values are not converted between transfer functions.
render::Image thumbnail(const ar::Frame& frame, int width) {
  const ar::ColorInfo color = ar::guess_color(frame.format.color, frame.format.width, frame.format.height);
  const LumaWeights weights = weights_of(color.matrix);
  const bool limited = color.range == ar::ColorRange::Limited;
  const double scale = 255.0 / 219.0;
  render::Image image;
  image.width = width;
  image.height =
      std::max(1, static_cast<int>(std::lround(static_cast<double>(width) * frame.format.height / frame.format.width)));
  const auto put = [&](double value) {
    image.rgba.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0)));
  };
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double code[3];
      for (std::size_t plane = 0; plane < 3; ++plane) {
        code[plane] =
            mean_sample(frame, plane, static_cast<double>(x) / image.width, static_cast<double>(y) / image.height,
                        (x + 1.0) / image.width, (y + 1.0) / image.height);
      }
      const double luma = limited ? (code[0] - 16.0 / 255.0) * scale : code[0];
      if (color.matrix == ar::ColorMatrix::Rgb) {  // planes G, B, R
        const double blue = limited ? (code[1] - 16.0 / 255.0) * scale : code[1];
        const double red = limited ? (code[2] - 16.0 / 255.0) * scale : code[2];
        put(red), put(luma), put(blue);
      } else {
        const double chroma_scale = limited ? 255.0 / 224.0 : 1.0;
        const double blue = luma + 2.0 * (1.0 - weights.blue) * (code[1] - 128.0 / 255.0) * chroma_scale;
        const double red = luma + 2.0 * (1.0 - weights.red) * (code[2] - 128.0 / 255.0) * chroma_scale;
        put(red);
        put((luma - weights.red * red - weights.blue * blue) / (1.0 - weights.red - weights.blue));
        put(blue);
      }
      image.rgba.push_back(255);
    }
  }
  return image;
}

std::int64_t count_frames(const std::string& path) {
  const auto source = ar::open_source(path);
  std::int64_t count = 0;
  while (source->next()) ++count;
  if (count == 0) throw ar::InputError(path + ": no frame in it");
  return count;
}

std::vector<render::Image> evenly_spaced(const std::string& path, const ContactSheetOptions& options) {
  const std::int64_t count = count_frames(path);
  const auto source = ar::open_source(path);
  std::vector<render::Image> images;
  std::int64_t index = 0;
  while (const auto frame = source->next()) {
    const auto wanted = static_cast<std::int64_t>(images.size());
    if (index++ == (2 * wanted + 1) * count / (2 * options.columns))
      images.push_back(thumbnail(*frame, options.cell_width));
    if (static_cast<int>(images.size()) == options.columns) break;
  }
  return images;
}

void paste(const render::Image& image, int left, int top, render::Image& sheet) {
  for (int y = 0; y < std::min(image.height, sheet.height - top); ++y) {
    const auto from = image.rgba.begin() + static_cast<std::ptrdiff_t>(y) * image.width * 4;
    std::copy(from, from + static_cast<std::ptrdiff_t>(image.width) * 4,
              sheet.rgba.begin() + (static_cast<std::ptrdiff_t>(top + y) * sheet.width + left) * 4);
  }
}

}  // namespace

void write_contact_sheet(const std::string& before, const std::string& after, const std::filesystem::path& sheet,
                         const ContactSheetOptions& options) {
  const std::vector<render::Image> above = evenly_spaced(before, options);
  const std::vector<render::Image> below = evenly_spaced(after, options);
  const int row_height = above.front().height;
  render::Image page;
  page.width = kGap + options.columns * (options.cell_width + kGap);
  page.height = 3 * kGap + row_height + below.front().height;
  page.rgba.assign(static_cast<std::size_t>(page.width) * static_cast<std::size_t>(page.height) * 4, 255);
  for (std::size_t i = 0; i < std::max(above.size(), below.size()); ++i) {
    const int left = kGap + static_cast<int>(i) * (options.cell_width + kGap);
    if (i < above.size()) paste(above[i], left, kGap, page);
    if (i < below.size()) paste(below[i], left, 2 * kGap + row_height, page);
  }
  render::write_png(sheet, page);
}

}  // namespace app
