#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/images/image_codec.h"
#include "render/scene/model.h"
#include "tests/testing/gltf_maker.h"

namespace {

using test::bytes_of;
using test::GltfMaker;
using test::triangle;
using testing::AllOf;
using testing::HasSubstr;

// The message with which the reader refuses these bytes; fails the test when it accepts them.
std::string refusal(const test::Bytes& bytes) {
  const test::TemporaryFolder folder;
  test::write(folder / "broken.glb", bytes);
  try {
    render::load_gltf(folder / "broken.glb");
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("broken.glb"));
    return error.what();
  }
  ADD_FAILURE() << "the broken file was accepted";
  return "";
}

std::string refusal(GltfMaker maker) {
  return refusal(maker.glb());
}

TEST(BrokenGltf, MissingFileIsNamed) {
  try {
    render::load_gltf("/nowhere/at/all.glb");
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("/nowhere/at/all.glb"), HasSubstr("No such file")));
  }
}

TEST(BrokenGltf, EmptyAndForeignFilesAreRefused) {
  EXPECT_THAT(refusal(test::Bytes{}), HasSubstr("empty"));
  EXPECT_THAT(refusal(bytes_of("solid cube\n")), HasSubstr("not a glTF file"));
  EXPECT_THAT(refusal(bytes_of("{\"asset\":{\"version\":\"1.0\"}}")), HasSubstr("version \"1.0\""));
}

TEST(BrokenGltf, EveryTruncationIsRefused) {
  const test::Bytes whole = triangle().glb();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    refusal(test::Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
  }
}

TEST(BrokenGltf, TruncationSaysHowMuchIsMissing) {
  test::Bytes half = triangle().glb();
  const std::size_t full = half.size();
  half.resize(half.size() - 20);
  EXPECT_THAT(refusal(half),
              AllOf(HasSubstr("truncated"), HasSubstr(std::to_string(full)), HasSubstr(std::to_string(half.size()))));
}

TEST(BrokenGltf, UnsupportedRequiredExtensionIsNamed) {
  GltfMaker maker = triangle();
  maker.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  EXPECT_THAT(refusal(maker), HasSubstr("KHR_draco_mesh_compression"));
}

TEST(BrokenGltf, IndexBeyondTheVerticesIsNamed) {
  GltfMaker maker = triangle();
  maker.primitive()["indices"] = maker.accessor(maker.view({0, 1, 3}), 5121, "SCALAR", 3);
  EXPECT_THAT(refusal(maker), AllOf(HasSubstr("index 3"), HasSubstr("3 vertices")));
}

TEST(BrokenGltf, AccessorBeyondItsViewIsNamed) {
  GltfMaker maker = triangle();
  maker.json["accessors"][0]["count"] = 4;
  EXPECT_THAT(refusal(maker), HasSubstr("accessor 0"));
  maker.json["accessors"][0]["count"] = 9007199254740992.0;
  EXPECT_THAT(refusal(maker), HasSubstr("accessor 0"));
}

TEST(BrokenGltf, ViewBeyondItsBufferIsNamed) {
  GltfMaker maker = triangle();
  maker.json["bufferViews"][0]["byteOffset"] = 4;
  EXPECT_THAT(refusal(maker), HasSubstr("buffer view 0"));
}

TEST(BrokenGltf, PositionThatIsNotFiniteIsNamed) {
  GltfMaker maker;
  maker.positions({0, 0, 0, 1, std::nanf(""), 0, 0, 1, 0});
  EXPECT_THAT(refusal(maker), HasSubstr("vertex 1"));
}

TEST(BrokenGltf, SceneWithoutTrianglesIsRefused) {
  GltfMaker points = triangle();
  points.primitive()["mode"] = 0;
  EXPECT_THAT(refusal(points), HasSubstr("no triangles"));
  GltfMaker nothing = triangle();
  nothing.json["nodes"] = {{{"name", "empty"}}};
  EXPECT_THAT(refusal(nothing), HasSubstr("no triangles"));
}

TEST(BrokenGltf, NodesThatFormACycleAreRefused) {
  GltfMaker maker = triangle();
  maker.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}, {"children", {0}}}};
  EXPECT_THAT(refusal(maker), HasSubstr("reached twice"));
}

TEST(BrokenGltf, WrongTypesNameKeyFoundAndAccepted) {
  GltfMaker maker = triangle();
  maker.json["nodes"][0]["translation"] = "up";
  EXPECT_THAT(refusal(maker),
              AllOf(HasSubstr("node 0"), HasSubstr("translation"), HasSubstr("\"up\""), HasSubstr("3 numbers")));
  maker = triangle();
  maker.json["nodes"][0]["mesh"] = -1;
  EXPECT_THAT(refusal(maker), AllOf(HasSubstr("`mesh` is -1"), HasSubstr("whole number")));
}

TEST(BrokenGltf, ImageThatIsNoImageIsNamed) {
  GltfMaker maker = triangle();
  maker.json["images"] = {{{"bufferView", maker.view(bytes_of("not a picture"))}}};
  maker.json["textures"] = {{{"source", 0}}};
  maker.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
  maker.primitive()["material"] = 0;
  EXPECT_THAT(refusal(maker), HasSubstr("image 0"));
}

TEST(BrokenGltf, MissingExternalFileIsNamed) {
  GltfMaker maker = triangle();
  maker.json["buffers"] = {{{"byteLength", 36}, {"uri", "gone.bin"}}};
  EXPECT_THAT(refusal(bytes_of(maker.json.dump())), AllOf(HasSubstr("gone.bin"), HasSubstr("No such file")));
}

// A model that uses every part of the reader.
GltfMaker rich_model() {
  GltfMaker maker = triangle();
  maker.attribute<float>("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  maker.attribute<std::uint16_t>("TEXCOORD_0", {0, 0, 65535, 0, 0, 65535}, 5123, "VEC2", 2);
  maker.json["accessors"][2]["normalized"] = true;
  maker.primitive()["indices"] = maker.accessor(maker.view({0, 1, 2}), 5121, "SCALAR", 3);
  maker.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", maker.view({1})}, {"componentType", 5121}}},
      {"values", {{"bufferView", maker.view(bytes_of(std::vector<float>{7, 0, 0}))}}}};
  render::Image image{4, 4, std::vector<std::uint8_t>(64, 200)};
  maker.json["images"] = {{{"bufferView", maker.view(render::encode_png(image))}},
                          {{"bufferView", maker.view(render::encode_jpeg(image, 90))}}};
  maker.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  maker.json["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}, {"normalTexture", {{"index", 1}}}}};
  maker.primitive()["material"] = 0;
  maker.json["nodes"] = {{{"children", {1}}, {"rotation", {0, 0, 0, 1}}}, {{"mesh", 0}, {"scale", {1, 2, 3}}}};
  return maker;
}

TEST(BrokenGltf, RichModelItselfIsRead) {
  const test::TemporaryFolder folder;
  test::write(folder / "rich.glb", rich_model().glb());
  EXPECT_EQ(render::load_gltf(folder / "rich.glb").images.size(), 2U);
}

// Under the sanitizers this also shows that nothing outside the file is touched.
TEST(BrokenGltf, DamagedBytesAreReadOrRefusedWithRuntimeError) {
  const test::Bytes whole = rich_model().glb();
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "damaged.glb";
  std::mt19937 random(20240621);
  int refused = 0;
  constexpr int kTrials = 1500;
  for (int trial = 0; trial < kTrials; ++trial) {
    test::Bytes bytes = whole;
    for (std::uint32_t flips = 1 + random() % 4; flips > 0; --flips) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    if (trial % 8 == 0) bytes.resize(random() % bytes.size());
    test::write(path, bytes);
    try {
      const render::Model model = render::load_gltf(path);
      EXPECT_GT(model.triangle_count(), 0U);
    } catch (const std::runtime_error&) {
      ++refused;
    } catch (const std::exception& error) {
      FAIL() << "trial " << trial << ": " << error.what();
    }
  }
  EXPECT_GT(refused, kTrials / 4) << "the damage hardly reached the reader";
}

}  // namespace
