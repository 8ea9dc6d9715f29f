// OpenEXR files as other programs write them, made through OpenEXR's own interface.

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>

#include "render/images/image_io.h"
#include "tests/testing/gltf_maker.h"

namespace {

using Imath::Box2i;
using Imath::V2f;
using render::LinearImage;
using testing::HasSubstr;

const Imf::Chromaticities kRec2020(V2f(0.708F, 0.292F), V2f(0.170F, 0.797F), V2f(0.131F, 0.046F),
                                   V2f(0.3127F, 0.3290F));

Box2i box(int left, int top, int right, int bottom) {
  return {{left, top}, {right, bottom}};
}

// ITU-R BT.2087, M2 inverted as BT.2407 prints it: linear Rec. 2020 to linear Rec. 709.
glm::vec3 rec709_from_rec2020(const glm::vec3& c) {
  return {1.6605F * c.x - 0.5876F * c.y - 0.0728F * c.z, -0.1246F * c.x + 1.1329F * c.y - 0.0083F * c.z,
          -0.0182F * c.x - 0.1006F * c.y + 1.1187F * c.z};
}

// A float file in which pixel (x, y) of the data window is (x, y, 1), in the file's coordinates.
void write_coordinates(const std::string& path, const Box2i& display, const Box2i& data) {
  const int width = data.max.x - data.min.x + 1;
  const int height = data.max.y - data.min.y + 1;
  std::vector<glm::vec3> pixels;
  for (int y = data.min.y; y <= data.max.y; ++y) {
    for (int x = data.min.x; x <= data.max.x; ++x) pixels.emplace_back(x, y, 1.0F);
  }
  Imf::Header header(display, data);
  Imf::FrameBuffer buffer;
  const char* names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
    buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, &pixels.front()[c], data, sizeof(glm::vec3),
                                             sizeof(glm::vec3) * static_cast<std::size_t>(width)));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(height);
}

// 8 x 8 pixels of one colour, half floats.
void write_constant(const std::string& path, const Imf::Header& header, const Imf::Rgba& color,
                    Imf::RgbaChannels channels) {
  const Box2i window = header.dataWindow();
  const int width = window.max.x - window.min.x + 1;
  const int height = window.max.y - window.min.y + 1;
  const std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), color);
  Imf::RgbaOutputFile file(path.c_str(), header, channels);
  file.setYCRounding(10, 10);  // all bits that a half float has
  file.setFrameBuffer(Imf::ComputeBasePointer(pixels.data(), window), 1, static_cast<std::size_t>(width));
  file.writePixels(height);
}

std::string refusal(const std::string& path) {
  try {
    render::read_exr(path);
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path));
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

TEST(ExrPrimaries, OfOtherColourSpacesAreConverted) {
  const test::TemporaryFolder folder;
  Imf::Header header(8, 8);
  Imf::addChromaticities(header, kRec2020);
  const Imf::Rgba color(4000.0F, 3600.0F, 1200.0F);
  const glm::vec3 expected = rec709_from_rec2020({4000.0F, 3600.0F, 1200.0F});
  for (const Imf::RgbaChannels channels : {Imf::WRITE_RGB, Imf::WRITE_YC}) {
    const std::string path = folder / "color.exr";
    write_constant(path, header, color, channels);
    const glm::vec3 read = render::read_exr(path).rgb[27];
    // Luminance and chroma are rounded to half floats, the printed matrix to four decimals.
    EXPECT_LT(glm::distance(read, expected), 0.002F * glm::length(expected))
        << channels << ": " << read.x << ' ' << read.y << ' ' << read.z;
  }
}

TEST(ExrPrimaries, LuminanceAloneStaysGrey) {
  const test::TemporaryFolder folder;
  Imf::Header header(8, 8);
  Imf::addChromaticities(header, kRec2020);
  write_constant(folder / "grey.exr", header, Imf::Rgba(64.0F, 64.0F, 64.0F), Imf::WRITE_Y);
  const glm::vec3 read = render::read_exr(folder / "grey.exr").rgb[27];
  EXPECT_NEAR(read.x, 64.0F, 0.1F);
  EXPECT_EQ(read, glm::vec3(read.x));
}

TEST(ExrPrimaries, ThatSpanNoColoursAreRefused) {
  const test::TemporaryFolder folder;
  for (const float x : {0.3F, std::numeric_limits<float>::quiet_NaN()}) {
    Imf::Header header(8, 8);
    const V2f point(x, 0.3F);
    Imf::addChromaticities(header, Imf::Chromaticities(point, point, point, point));
    write_constant(folder / "line.exr", header, Imf::Rgba(1.0F, 1.0F, 1.0F), Imf::WRITE_RGB);
    refusal(folder / "line.exr");
  }
}

TEST(ExrWindows, DataStandsWhereItBelongsInTheDisplayWindow) {
  const test::TemporaryFolder folder;
  const Box2i display = box(-4, 10, 11, 17);
  const Box2i windows[] = {display, box(0, 12, 5, 15), box(-9, 7, 20, 30), box(8, 5, 14, 11), box(20, 10, 30, 17)};
  for (const Box2i& data : windows) {
    const std::string path = folder / "window.exr";
    write_coordinates(path, display, data);
    const LinearImage image = render::read_exr(path);
    ASSERT_EQ(image.width, 16);
    ASSERT_EQ(image.height, 8);
    for (int y = 10; y <= 17; ++y) {
      for (int x = -4; x <= 11; ++x) {
        const glm::vec3 expected = data.intersects({x, y}) ? glm::vec3(x, y, 1.0F) : glm::vec3(0.0F);
        EXPECT_EQ(image.rgb[static_cast<std::size_t>((y - 10) * 16 + x + 4)], expected)
            << x << ' ' << y << " of data from " << data.min.x << ' ' << data.min.y;
      }
    }
  }
}

TEST(ExrWindows, LuminanceAndChromaAreFramedToo) {
  const test::TemporaryFolder folder;
  const Imf::Header header(box(0, 0, 15, 7), box(4, 2, 11, 5));
  write_constant(folder / "chroma.exr", header, Imf::Rgba(2.0F, 2.0F, 2.0F), Imf::WRITE_YC);
  const LinearImage image = render::read_exr(folder / "chroma.exr");
  ASSERT_EQ(image.width, 16);
  ASSERT_EQ(image.height, 8);
  EXPECT_EQ(image.rgb[1 * 16 + 4], glm::vec3(0.0F));
  EXPECT_NEAR(image.rgb[2 * 16 + 4].y, 2.0F, 0.01F);
  EXPECT_NEAR(image.rgb[5 * 16 + 11].y, 2.0F, 0.01F);
  EXPECT_EQ(image.rgb[5 * 16 + 12], glm::vec3(0.0F));
}

TEST(ExrSize, BlackPicturesOfEveryCompressionAreRead) {
  const test::TemporaryFolder folder;
  for (int kind = 0; kind < Imf::NUM_COMPRESSION_METHODS; ++kind) {
    for (const Imf::RgbaChannels channels : {Imf::WRITE_RGB, Imf::WRITE_Y}) {
      Imf::Header header(1024, 1024);
      header.compression() = static_cast<Imf::Compression>(kind);
      write_constant(folder / "black.exr", header, Imf::Rgba(0.0F, 0.0F, 0.0F), channels);
      EXPECT_EQ(render::read_exr(folder / "black.exr").rgb.size(), 1024U * 1024U) << kind;
    }
  }
}

// A file of which only the header was written claims what it cannot hold.
TEST(ExrSize, ClaimsBeyondTheFileAreRefusedBeforeMemoryIsTaken) {
  const test::TemporaryFolder folder;
  const auto refused = [&](const Box2i& display, const Box2i& data) {
    Imf::Header header(display, data);
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    { const Imf::OutputFile file((folder / "claim.exr").c_str(), header); }
    return refusal(folder / "claim.exr");
  };
  const Box2i large = box(0, 0, 15999, 15999);
  EXPECT_THAT(refused(large, large), HasSubstr("its data window of 16000 x 16000 pixels cannot be in a file of"));
  EXPECT_THAT(refused(large, box(0, 0, 1, 1)), HasSubstr("its display window of 16000 x 16000 pixels"));
  EXPECT_THAT(refused(box(0, 0, 0, 0), box(0, 0, 99999, 0)), HasSubstr("has a side of more than 65536 pixels"));
}

TEST(ExrChannels, ThatAreNotKnownAreNamed) {
  const test::TemporaryFolder folder;
  Imf::Header header(4, 4);
  header.channels().insert("depth.Z", Imf::Channel(Imf::FLOAT));
  { const Imf::OutputFile file((folder / "depth.exr").c_str(), header); }
  EXPECT_THAT(refusal(folder / "depth.exr"), HasSubstr("found the channels depth.Z, accepted are R, G, B"));
}

}  // namespace
