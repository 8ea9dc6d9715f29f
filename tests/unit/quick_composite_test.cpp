// The CPU's composite against the formula, and what it must leave alone.

#include "render/composite/quick_composite.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "render/composite/picture_math.h"
#include "render/composite/planes.h"

namespace {

using render::Chroma;
using render::MergedPicture;
using render::MergedPixel;
using render::PictureFormat;

// A picture with planes of its own.
struct Picture {
  PictureFormat format;
  std::array<std::vector<std::uint8_t>, 3> bytes;

  explicit Picture(const PictureFormat& f) : format(f) {
    for (int p = 0; p < 3; ++p) bytes.at(static_cast<std::size_t>(p)).resize(size_of(p));
  }
  std::size_t size_of(int plane) const {
    const glm::ivec2 size = render::plane_size(format, plane);
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y * render::sample_bytes(format));
  }
  std::ptrdiff_t stride(int plane) const {
    return std::ptrdiff_t{render::plane_size(format, plane).x} * render::sample_bytes(format);
  }
  void set(int plane, std::size_t i, unsigned code) {
    auto& plane_bytes = bytes.at(static_cast<std::size_t>(plane));
    const auto bytes_each = static_cast<std::size_t>(render::sample_bytes(format));
    std::memcpy(plane_bytes.data() + i * bytes_each, &code, bytes_each);
  }
  unsigned get(int plane, int x, int y) const {
    unsigned code = 0;
    const auto bytes_each = static_cast<std::size_t>(render::sample_bytes(format));
    const auto at = static_cast<std::size_t>(y * stride(plane)) + static_cast<std::size_t>(x) * bytes_each;
    std::memcpy(&code, bytes.at(static_cast<std::size_t>(plane)).data() + at, bytes_each);
    return code;
  }
  render::PictureView view() const {
    return {format, {bytes[0].data(), bytes[1].data(), bytes[2].data()}, {stride(0), stride(1), stride(2)}};
  }
  render::MutablePictureView writable() {
    return {format, {bytes[0].data(), bytes[1].data(), bytes[2].data()}, {stride(0), stride(1), stride(2)}};
  }
};

PictureFormat format_of(int bit_depth, Chroma chroma) {
  PictureFormat format;
  format.width = 37;  // odd, so that blocks are cut at the edges
  format.height = 23;
  format.bit_depth = bit_depth;
  format.chroma = chroma;
  return format;
}

// Noise in the luma, one colour.
Picture noise(const PictureFormat& format) {
  std::mt19937 random(4);
  const unsigned step = format.bit_depth > 8 ? 4 : 1;
  std::uniform_int_distribution<unsigned> luma(40 * step, 200 * step);
  Picture picture(format);
  for (int plane = 0; plane < 3; ++plane) {
    const std::size_t count = picture.size_of(plane) / static_cast<std::size_t>(render::sample_bytes(format));
    for (std::size_t i = 0; i < count; ++i) {
      picture.set(plane, i, plane == 0 ? luma(random) : (plane == 1 ? 120 : 135) * step);
    }
  }
  return picture;
}

MergedPicture merged_of(const MergedPixel& pixel) {
  return {.width = 12, .height = 8, .pixels = std::vector<MergedPixel>(96, pixel)};
}

Picture composited(const Picture& in, const MergedPicture& merged, const std::shared_ptr<render::LensMap>& lens = {}) {
  render::Camera camera;
  camera.width = in.format.width;
  camera.height = in.format.height;
  camera.lens = lens;
  render::View view;
  view.width = merged.width;
  view.height = merged.height;
  view.focal_px = {merged.width, merged.height};
  Picture out(in.format);
  render::QuickComposite(2).draw(camera, view, merged, in.view(), out.writable());
  return out;
}

// The definition: (picture without its shoulder * keep + add), shoulder, code.
glm::vec3 expected_code(const PictureFormat& format, const glm::vec3& code, const glm::vec3& keep,
                        const glm::vec3& add) {
  const render::CodeTransform decode = render::rgb_from_code(format);
  const render::CodeTransform encode = render::code_from_rgb(format);
  const glm::vec3 shown(decode.matrix * glm::dvec3(code) + decode.offset);
  const glm::vec3 light = render::shoulder_inverse(render::linear_from_coded(format.transfer, shown)) * keep + add;
  const glm::vec3 made = render::coded_from_linear(format.transfer, render::shoulder(light));
  return glm::vec3(encode.matrix * glm::dvec3(glm::min(made, glm::max(shown, 1.0F))) + encode.offset);
}

class QuickComposite : public testing::TestWithParam<std::pair<int, Chroma>> {
 protected:
  const PictureFormat format_ = format_of(GetParam().first, GetParam().second);
  const Picture in_ = noise(format_);
};

TEST_P(QuickComposite, FollowsTheFormula) {
  const MergedPixel layer{.keep = {128, 200, 230, 255}, .add = {90, 60, 30, 255}};
  const Picture out = composited(in_, merged_of(layer));
  const glm::vec3 keep = glm::vec3(128, 200, 230) / 255.0F;
  const glm::vec3 root = glm::vec3(90, 60, 30) / 255.0F;
  const glm::vec3 add = root * root * render::kMergedWhite;
  // Dither and rounding take up to a whole step, the tables a quarter of an 8-bit one.
  const double tolerance = format_.bit_depth > 8 ? 2.0 : 1.25;
  for (int y = 0; y < format_.height; ++y) {
    for (int x = 0; x < format_.width; ++x) {
      const unsigned step = format_.bit_depth > 8 ? 4 : 1;
      const glm::vec3 code(in_.get(0, x, y), 120 * step, 135 * step);
      ASSERT_NEAR(out.get(0, x, y), expected_code(format_, code, keep, add).x, tolerance) << x << ", " << y;
    }
  }
}

TEST_P(QuickComposite, LeavesWhatNothingIsLaidOverToTheBit) {
  EXPECT_EQ(composited(in_, merged_of({})).bytes, in_.bytes);
  MergedPicture corner = merged_of({});
  corner.pixels[0] = {.keep = {0, 0, 0, 255}, .add = {0, 0, 0, 255}};
  const Picture out = composited(in_, corner);
  EXPECT_LT(out.get(0, 0, 0), in_.get(0, 0, 0));
  for (int x = 12; x < format_.width; ++x) EXPECT_EQ(out.get(0, x, 20), in_.get(0, x, 20));
}

INSTANTIATE_TEST_SUITE_P(Formats, QuickComposite,
                         testing::Values(std::pair(8, Chroma::C420), std::pair(8, Chroma::C422),
                                         std::pair(8, Chroma::C444), std::pair(10, Chroma::C420)));

TEST(QuickCompositeLens, LooksThroughTheLensMap) {
  const PictureFormat format = format_of(8, Chroma::C444);
  const Picture in = noise(format);
  MergedPicture merged = merged_of({});
  for (int y = 0; y < merged.height; ++y)
    merged.pixels[static_cast<std::size_t>(y * merged.width)].keep = {0, 0, 0, 255};
  // Every pixel looks at the left edge, but those of the last column look nowhere.
  const auto lens = std::make_shared<render::LensMap>();
  lens->width = format.width;
  lens->height = format.height;
  for (int y = 0; y < format.height; ++y) {
    for (int x = 0; x < format.width; ++x) {
      const float nowhere = std::numeric_limits<float>::quiet_NaN();
      lens->ideal.emplace_back(x + 1 < format.width ? 0.02F : nowhere, 0.5F);
    }
  }
  const Picture out = composited(in, merged, lens);
  for (int y = 0; y < format.height; ++y) {
    EXPECT_LE(out.get(0, 5, y), 18U);
    EXPECT_EQ(out.get(0, format.width - 1, y), in.get(0, format.width - 1, y));
  }
}

}  // namespace
