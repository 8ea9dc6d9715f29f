// The composite pass on pictures whose right answer is known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "render/composite/composite_pass.h"
#include "render/composite/picture_math.h"
#include "render/composite/planes.h"
#include "render/gl/context.h"

namespace {

using render::Chroma;
using render::ChromaSiting;
using render::ColorMatrix;
using render::ColorRange;
using render::PictureFormat;
using render::PixelRect;
using render::Transfer;

// A picture that owns its planes; rows are padded as video buffers are.
class Planes {
 public:
  explicit Planes(const PictureFormat& format, int row_alignment = 32) : format_(format) {
    for (int p = 0; p < 3; ++p) {
      const glm::ivec2 size = render::plane_size(format, p);
      const int bytes = size.x * render::sample_bytes(format);
      stride_[static_cast<std::size_t>(p)] = (bytes + row_alignment - 1) / row_alignment * row_alignment;
      data_[static_cast<std::size_t>(p)].assign(static_cast<std::size_t>(stride_[static_cast<std::size_t>(p)] * size.y),
                                                0xA5);
    }
  }

  int get(int plane, int x, int y) const {
    const std::uint8_t* at = address(plane, x, y);
    return format_.bit_depth > 8 ? at[0] | (at[1] << 8) : at[0];
  }
  void set(int plane, int x, int y, int code) {
    auto* at = const_cast<std::uint8_t*>(address(plane, x, y));
    at[0] = static_cast<std::uint8_t>(code & 0xFF);
    if (format_.bit_depth > 8) at[1] = static_cast<std::uint8_t>(code >> 8);
  }
  render::PictureView view() const {
    render::PictureView v{.format = format_};
    for (std::size_t p = 0; p < 3; ++p) {
      v.plane[p] = data_[p].data();
      v.stride_bytes[p] = stride_[p];
    }
    return v;
  }
  render::MutablePictureView mutable_view() {
    render::MutablePictureView v{.format = format_};
    for (std::size_t p = 0; p < 3; ++p) {
      v.plane[p] = data_[p].data();
      v.stride_bytes[p] = stride_[p];
    }
    return v;
  }
  const PictureFormat& format() const { return format_; }

 private:
  const std::uint8_t* address(int plane, int x, int y) const {
    const auto p = static_cast<std::size_t>(plane);
    return data_[p].data() + y * stride_[p] + x * render::sample_bytes(format_);
  }

  PictureFormat format_;
  std::array<std::vector<std::uint8_t>, 3> data_;
  std::array<std::ptrdiff_t, 3> stride_{};
};

// Every luma code against chroma that sweeps its own range: all codes of each plane occur.
void fill_with_all_codes(Planes& planes) {
  const PictureFormat& format = planes.format();
  const render::CodeLimits limits = render::code_limits(format);
  const int codes = limits.max - limits.min + 1;
  for (int plane = 0; plane < 3; ++plane) {
    const glm::ivec2 size = render::plane_size(format, plane);
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const int step = plane == 0 ? x + 7 * y : (plane == 1 ? 3 * x + 5 * y : 5 * y + 11 * x + 40);
        planes.set(plane, x, y, limits.min + step % codes);
      }
    }
  }
}

// The same within the colours that a display has: greys and tints whose R, G, B all lie inside 0 to 1.
void fill_with_displayable_codes(Planes& planes) {
  const PictureFormat& format = planes.format();
  const render::CodeTransform code_from_rgb = render::code_from_rgb(format);
  for (int plane = 0; plane < 3; ++plane) {
    const glm::ivec2 size = render::plane_size(format, plane);
    const glm::ivec2 scale = render::plane_size(format, 0) / size;
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const double along = static_cast<double>(x * scale.x) / (format.width - 1);
        const double down = static_cast<double>(y * scale.y) / (format.height - 1);
        const glm::dvec3 rgb(along, 0.25 + 0.5 * down, 1.0 - along);
        planes.set(plane, x, y,
                   static_cast<int>(std::lround((code_from_rgb.matrix * rgb + code_from_rgb.offset)[plane])));
      }
    }
  }
}

int largest_difference(const Planes& a, const Planes& b) {
  int largest = 0;
  for (int plane = 0; plane < 3; ++plane) {
    const glm::ivec2 size = render::plane_size(a.format(), plane);
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        largest = std::max(largest, std::abs(a.get(plane, x, y) - b.get(plane, x, y)));
      }
    }
  }
  return largest;
}

std::string name_of(const PictureFormat& f) {
  const char* matrices[] = {"unknown", "rgb", "601", "709", "2020"};
  const char* chromas[] = {"420", "422", "444"};
  const char* sitings[] = {"unknown", "left", "centre", "topleft"};
  return std::string(matrices[static_cast<int>(f.matrix)]) + (f.range == ColorRange::Full ? "_full_" : "_limited_") +
         std::to_string(f.bit_depth) + "bit_" + chromas[static_cast<int>(f.chroma)] + "_" +
         sitings[static_cast<int>(f.siting)] + "_transfer" + std::to_string(static_cast<int>(f.transfer));
}

// Constant layers as textures.
class ConstantLayers {
 public:
  ConstantLayers(int width, int height, const glm::vec3& multiplier, const glm::vec3& added)
      : added_(GL_RGBA16F, width, height), multiplier_(GL_RGBA16F, width, height), depth_(GL_R32F, width, height) {
    const auto n = static_cast<std::size_t>(width * height);
    added_.upload(GL_RGBA, GL_FLOAT, std::vector<glm::vec4>(n, glm::vec4(added, 1.0F)).data());
    multiplier_.upload(GL_RGBA, GL_FLOAT, std::vector<glm::vec4>(n, glm::vec4(multiplier, 1.0F)).data());
    depth_.upload(GL_RED, GL_FLOAT, std::vector<float>(n, 1.0F).data());
    picture_ = {added_.id(), multiplier_.id(), depth_.id(), width, height, {0, 0, width, height}};
  }
  const render::ObjectsPicture& picture() const { return picture_; }

 private:
  render::gl::Texture added_;
  render::gl::Texture multiplier_;
  render::gl::Texture depth_;
  render::ObjectsPicture picture_;
};

class CompositePassTest : public testing::Test {
 protected:
  Planes run(const Planes& in, const render::CompositeLayers& layers, const PixelRect& changed, int alignment = 32) {
    Planes out(in.format(), alignment);
    const PixelRect region = render::CompositePass::region(in.format(), changed);
    pass_.upload(in.view(), region);
    pass_.draw(layers, region);
    pass_.read(in.view(), out.mutable_view(), region);
    return out;
  }
  Planes lay_over(const Planes& in, const glm::vec3& multiplier, const glm::vec3& added) {
    const PictureFormat& f = in.format();
    const ConstantLayers layers(f.width, f.height, multiplier, added);
    return run(in, {.objects = &layers.picture()}, {0, 0, f.width, f.height});
  }

  render::gl::Context context_;
  render::CompositePass pass_;
};

std::vector<PictureFormat> all_formats() {
  std::vector<PictureFormat> formats;
  for (const int depth : {8, 10}) {
    for (const Chroma chroma : {Chroma::C420, Chroma::C422, Chroma::C444}) {
      for (const ColorMatrix matrix : {ColorMatrix::Bt601, ColorMatrix::Bt709, ColorMatrix::Bt2020}) {
        for (const ColorRange range : {ColorRange::Limited, ColorRange::Full}) {
          formats.push_back({128, 64, depth, chroma, ChromaSiting::Left, matrix, range, Transfer::Bt709});
        }
      }
      formats.push_back(
          {128, 64, depth, chroma, ChromaSiting::Center, ColorMatrix::Bt601, ColorRange::Full, Transfer::Srgb});
      formats.push_back(
          {128, 64, depth, chroma, ChromaSiting::TopLeft, ColorMatrix::Bt2020, ColorRange::Limited, Transfer::Gamma22});
    }
    formats.push_back(
        {128, 64, depth, Chroma::C444, ChromaSiting::Left, ColorMatrix::Rgb, ColorRange::Full, Transfer::Srgb});
  }
  return formats;
}

TEST_F(CompositePassTest, UntouchedPicturesOfEveryFormatComeOutExactly) {
  for (const PictureFormat& format : all_formats()) {
    Planes in(format);
    fill_with_all_codes(in);
    EXPECT_EQ(largest_difference(lay_over(in, glm::vec3(1.0F), glm::vec3(0.0F)), in), 0) << name_of(format);
  }
}

// A change far below a code step, even of a pure power near black, keeps the pass from taking the source's own codes:
// decode and encode are really run.
TEST_F(CompositePassTest, DecodingAndEncodingReturnsEveryFormatsCodes) {
  for (const PictureFormat& format : all_formats()) {
    Planes in(format);
    fill_with_displayable_codes(in);
    const Planes out = lay_over(in, glm::vec3(1.0F), glm::vec3(6e-8F));
    // One step for the dither where a value falls between two.
    EXPECT_LE(largest_difference(out, in), 1) << name_of(format);
  }
}

TEST_F(CompositePassTest, RowsThatAreNotMultiplesOfFourAreRight) {
  for (const Chroma chroma : {Chroma::C420, Chroma::C422, Chroma::C444}) {
    for (const int depth : {8, 10}) {
      const PictureFormat format{.width = 101, .height = 35, .bit_depth = depth, .chroma = chroma};
      Planes in(format, 1);
      fill_with_all_codes(in);
      const ConstantLayers layers(101, 35, glm::vec3(1.0F), glm::vec3(0.0F));
      const Planes out = run(in, {.objects = &layers.picture()}, {0, 0, 101, 35}, 1);
      EXPECT_EQ(largest_difference(out, in), 0) << name_of(format);
    }
  }
}

TEST_F(CompositePassTest, OutsideTheRegionTheSourcesBytesStay) {
  const PictureFormat format{.width = 128, .height = 64};
  Planes in(format);
  fill_with_displayable_codes(in);
  const ConstantLayers layers(128, 64, glm::vec3(0.25F), glm::vec3(0.1F));
  const PixelRect changed{33, 21, 30, 11};
  const PixelRect region = render::CompositePass::region(format, changed);
  const Planes out = run(in, {.objects = &layers.picture()}, changed);
  int changed_inside = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) {
      const bool inside = x >= region.x && y >= region.y && x < region.x + region.width && y < region.y + region.height;
      const bool differs = out.get(0, x, y) != in.get(0, x, y);
      EXPECT_TRUE(inside || !differs) << x << ", " << y;
      if (inside && differs) ++changed_inside;
    }
  }
  EXPECT_GE(changed_inside, 30 * 11);
}

TEST_F(CompositePassTest, ShadowAndAddedLightActInLinearLight) {
  for (const PictureFormat& format : all_formats()) {
    Planes in(format);
    const glm::dvec3 source_rgb(0.5, 0.4, 0.3);
    const render::CodeTransform code_from_rgb = render::code_from_rgb(format);
    const render::CodeTransform rgb_from_code = render::rgb_from_code(format);
    const glm::dvec3 code = glm::round(code_from_rgb.matrix * source_rgb + code_from_rgb.offset);
    for (int plane = 0; plane < 3; ++plane) {
      const glm::ivec2 size = render::plane_size(format, plane);
      for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) in.set(plane, x, y, static_cast<int>(code[plane]));
      }
    }
    const glm::vec3 multiplier(0.5F, 0.6F, 0.7F);
    const glm::vec3 added(0.02F, 0.04F, 0.06F);
    const Planes out = lay_over(in, multiplier, added);
    const glm::vec3 coded(rgb_from_code.matrix * code + rgb_from_code.offset);
    glm::vec3 virtual_light = added;
    if (format.matrix == ColorMatrix::Bt2020) virtual_light = glm::mat3(render::bt2020_from_709()) * added;
    const glm::vec3 linear = render::linear_from_coded(format.transfer, coded) * multiplier + virtual_light;
    const glm::dvec3 expected =
        code_from_rgb.matrix * glm::dvec3(render::coded_from_linear(format.transfer, linear)) + code_from_rgb.offset;
    for (int plane = 0; plane < 3; ++plane) {
      const glm::ivec2 at = render::plane_size(format, plane) / 2;
      // Dither reaches half a step to either side, half-float layers some thousandths.
      EXPECT_NEAR(out.get(plane, at.x, at.y), expected[plane], 1.1) << name_of(format) << ", plane " << plane;
    }
  }
}

TEST_F(CompositePassTest, OpaqueThingsLeaveNothingOfThePictureBehindThem) {
  const PictureFormat format{.width = 128, .height = 64};
  Planes in(format);
  fill_with_all_codes(in);
  const Planes out = lay_over(in, glm::vec3(0.0F), glm::vec3(0.2F, 0.3F, 0.1F));
  const glm::ivec2 chroma = render::plane_size(format, 1);
  for (int plane = 0; plane < 3; ++plane) {
    const glm::ivec2 size = plane == 0 ? glm::ivec2(128, 64) : chroma;
    int low = 255;
    int high = 0;
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        low = std::min(low, out.get(plane, x, y));
        high = std::max(high, out.get(plane, x, y));
      }
    }
    EXPECT_LE(high - low, 1) << "plane " << plane << ": one colour, dithered";
  }
}

TEST_F(CompositePassTest, EqualFramesGiveEqualBytes) {
  const PictureFormat format{.width = 128, .height = 64};
  Planes in(format);
  fill_with_displayable_codes(in);
  const Planes first = lay_over(in, glm::vec3(0.7F), glm::vec3(0.05F));
  const Planes second = lay_over(in, glm::vec3(0.7F), glm::vec3(0.05F));
  EXPECT_EQ(largest_difference(first, second), 0);
}

TEST_F(CompositePassTest, AddedLightRollsOffBelowWhite) {
  const PictureFormat format{.width = 64, .height = 32, .chroma = Chroma::C444, .range = ColorRange::Full};
  Planes in(format);
  fill_with_displayable_codes(in);
  const Planes out = lay_over(in, glm::vec3(0.0F), glm::vec3(1.0F));
  // Linear 1 lies on the shoulder, below white: steps remain for brighter light.
  const float shown = render::shoulder(glm::vec3(1.0F)).x;
  EXPECT_NEAR(out.get(0, 20, 20), 255.0F * render::coded_from_linear(Transfer::Bt709, glm::vec3(shown)).x, 1.0);
  EXPECT_LT(out.get(0, 20, 20), 254);
}

}  // namespace
