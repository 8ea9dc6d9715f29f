#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "render/images/image_codec.h"
#include "render/scene/model.h"
#include "tests/testing/gltf_maker.h"

namespace {

using render::load_gltf;
using render::Model;
using test::bytes_of;
using test::GltfMaker;
using test::Json;
using test::triangle;

constexpr float kTight = 1e-6F;  // a few float roundings of numbers about 1

Model load(GltfMaker maker) {
  const test::TemporaryFolder folder;
  test::write(folder / "model.glb", maker.glb());
  return load_gltf(folder / "model.glb");
}

glm::vec3 position(const Model& model, std::size_t corner) {
  return model.meshes[0].vertices[model.meshes[0].indices[corner]].position;
}

glm::vec3 face_normal(const Model& model, std::size_t face) {
  const glm::vec3 a = position(model, 3 * face);
  return glm::normalize(glm::cross(position(model, 3 * face + 1) - a, position(model, 3 * face + 2) - a));
}

void expect_near(const glm::vec3& found, const glm::vec3& expected, float tolerance = kTight) {
  EXPECT_LE(glm::distance(found, expected), tolerance)
      << "found " << found.x << ' ' << found.y << ' ' << found.z << ", expected " << expected.x << ' ' << expected.y
      << ' ' << expected.z;
}

TEST(Gltf, UpIsTheWorldsUpAndMinusZIsNorth) {
  GltfMaker maker;
  maker.positions({0, 0, 0, 1, 2, -3, 0, 1, 0});
  expect_near(position(load(maker), 1), {1, 3, 2});
}

TEST(Gltf, MissingNormalsAreTheFacesOwn) {
  const Model model = load(triangle());
  ASSERT_EQ(model.triangle_count(), 1U);
  for (const render::Vertex& vertex : model.meshes[0].vertices) expect_near(vertex.normal, {0, -1, 0});
}

TEST(Gltf, ComputedTangentFollowsUAndTheBitangentPointsUpInThePicture) {
  GltfMaker maker = triangle();
  // v = 1 at the lower edge: the picture stands upright on the triangle.
  maker.attribute<float>("TEXCOORD_0", {0, 1, 1, 1, 0, 0}, 5126, "VEC2", 2);
  const Model model = load(maker);
  for (const render::Vertex& vertex : model.meshes[0].vertices) {
    expect_near(glm::vec3(vertex.tangent), {1, 0, 0});
    expect_near(glm::cross(vertex.normal, glm::vec3(vertex.tangent)) * vertex.tangent.w, {0, 0, 1});
  }
}

TEST(Gltf, VerticesBetweenMirroredTexturesAreSplit) {
  GltfMaker maker;
  maker.positions({-1, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0});
  maker.attribute<float>("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  maker.attribute<float>("TEXCOORD_0", {1, 1, 0, 1, 0, 0, 1, 1}, 5126, "VEC2", 2);
  maker.primitive()["indices"] =
      maker.accessor(maker.view(bytes_of(std::vector<std::uint8_t>{0, 1, 2, 1, 3, 2})), 5121, "SCALAR", 6);
  const Model model = load(maker);
  EXPECT_EQ(model.meshes[0].vertices.size(), 6U);
  const auto sign = [&](std::size_t corner) {
    return model.meshes[0].vertices[model.meshes[0].indices[corner]].tangent.w;
  };
  EXPECT_EQ(sign(0), sign(1));
  EXPECT_EQ(sign(3), sign(5));
  EXPECT_NE(sign(0), sign(3));
}

TEST(Gltf, IndicesOfEveryWidthAreRead) {
  const std::vector<std::uint32_t> order = {2, 0, 1};
  const test::Bytes as8 = {2, 0, 1};
  const test::Bytes as16 = bytes_of(std::vector<std::uint16_t>{2, 0, 1});
  const test::Bytes as32 = bytes_of(order);
  for (const auto& [type, bytes] : {std::pair{5121, as8}, {5123, as16}, {5125, as32}}) {
    GltfMaker maker = triangle();
    maker.primitive()["indices"] = maker.accessor(maker.view(bytes), type, "SCALAR", 3);
    const Model model = load(maker);
    expect_near(position(model, 0), {0, 0, 1});
    expect_near(position(model, 1), {0, 0, 0});
  }
}

TEST(Gltf, StripsAndFansBecomeTrianglesThatFaceTheSameWay) {
  for (const int mode : {5, 6}) {
    GltfMaker maker;
    if (mode == 5) maker.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    if (mode == 6) maker.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    maker.primitive()["mode"] = mode;
    const Model model = load(maker);
    ASSERT_EQ(model.triangle_count(), 2U) << "mode " << mode;
    expect_near(face_normal(model, 0), {0, -1, 0});
    expect_near(face_normal(model, 1), {0, -1, 0});
  }
}

TEST(Gltf, DegenerateTrianglesOfAStripAreLeftOut) {
  GltfMaker maker = triangle();
  maker.primitive()["mode"] = 5;
  maker.primitive()["indices"] =
      maker.accessor(maker.view(bytes_of(std::vector<std::uint8_t>{0, 1, 2, 2})), 5121, "SCALAR", 4);
  EXPECT_EQ(load(maker).triangle_count(), 1U);
}

TEST(Gltf, InterleavedAttributesAreRead) {
  GltfMaker maker;
  const std::size_t view = maker.view(bytes_of(std::vector<float>{0, 0, 0, 0, 0, 1,  //
                                                                  2, 0, 0, 0, 0, 1,  //
                                                                  0, 2, 0, 0, 0, 1}),
                                      24);
  maker.primitive()["attributes"]["POSITION"] = maker.accessor(view, 5126, "VEC3", 3);
  maker.primitive()["attributes"]["NORMAL"] = maker.accessor(view, 5126, "VEC3", 3);
  maker.json["accessors"][1]["byteOffset"] = 12;
  const Model model = load(maker);
  expect_near(position(model, 1), {2, 0, 0});
  expect_near(model.meshes[0].vertices[1].normal, {0, -1, 0});
}

TEST(Gltf, SparseAccessorReplacesItsElements) {
  GltfMaker maker = triangle();
  const std::size_t places = maker.view({1});
  const std::size_t values = maker.view(bytes_of(std::vector<float>{7, 0, 0}));
  maker.json["accessors"][0]["sparse"] = {{"count", 1},
                                          {"indices", {{"bufferView", places}, {"componentType", 5121}}},
                                          {"values", {{"bufferView", values}}}};
  expect_near(position(load(maker), 1), {7, 0, 0});
}

TEST(Gltf, NormalizedIntegersAreScaled) {
  GltfMaker maker = triangle();
  maker.attribute<std::uint8_t>("TEXCOORD_0", {0, 0, 255, 0, 0, 51}, 5121, "VEC2", 2);
  maker.json["accessors"][1]["normalized"] = true;
  const Model model = load(maker);
  EXPECT_NEAR(model.meshes[0].vertices[1].uv.x, 1.0F, kTight);
  EXPECT_NEAR(model.meshes[0].vertices[2].uv.y, 0.2F, kTight);
}

TEST(Gltf, QuantizedPositionsAreRead) {
  GltfMaker maker;
  maker.attribute<std::int16_t>("POSITION", {0, 0, 0, 100, 0, 0, 0, -50, 0}, 5122, "VEC3", 3);
  maker.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  expect_near(position(load(maker), 2), {0, 0, -50});
}

TEST(Gltf, NodesTranslateRotateScaleInThatOrder) {
  GltfMaker maker = triangle();
  const double h = std::sqrt(0.5);
  maker.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                         {{"mesh", 0}, {"rotation", {0, 0, h, h}}, {"scale", {2, 3, 4}}}};
  // (1, 0, 0) doubled, turned a quarter about glTF's z to y, moved 10 along x; then y is up.
  expect_near(position(load(maker), 1), {10, 0, 2}, 1e-5F);
}

TEST(Gltf, MatrixNodeEqualsItsColumns) {
  GltfMaker maker = triangle();
  maker.json["nodes"][0]["matrix"] = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};
  expect_near(position(load(maker), 1), {5, -7, 7});
}

TEST(Gltf, MirroringNodeKeepsFacesOutward) {
  GltfMaker maker = triangle();
  maker.attribute<float>("NORMAL", {0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  maker.json["nodes"][0]["scale"] = {-1, 1, 1};
  const Model model = load(maker);
  expect_near(face_normal(model, 0), {0, -1, 0});
  expect_near(model.meshes[0].vertices[0].normal, {0, -1, 0});
}

TEST(Gltf, UnevenScaleKeepsNormalsOrthogonal) {
  GltfMaker maker;
  maker.positions({0, 0, 0, 0, 0, -1, 1, 1, 0});
  maker.json["nodes"][0]["scale"] = {3, 0.5, 2};
  const Model model = load(maker);
  expect_near(model.meshes[0].vertices[0].normal, face_normal(model, 0), 1e-5F);
}

TEST(Gltf, TwoNodesMayShareAMesh) {
  GltfMaker maker = triangle();
  maker.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 4, 0}}}};
  maker.json["scenes"][0]["nodes"] = {0, 1};
  const Model model = load(maker);
  EXPECT_EQ(model.triangle_count(), 2U);
  expect_near(model.bounds_max, {1, 0, 5});
}

TEST(Gltf, MaterialIsReadWithGltfsDefaults) {
  GltfMaker maker = triangle();
  maker.json["materials"] = {{{"name", "leaf"},
                              {"alphaMode", "MASK"},
                              {"doubleSided", true},
                              {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 1.0}}}},
                              {"emissiveFactor", {1, 0.5, 0}},
                              {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}}}};
  maker.primitive()["material"] = 0;
  const Model model = load(maker);
  const render::Material& material = model.materials[static_cast<std::size_t>(model.meshes[0].material)];
  EXPECT_EQ(material.name, "leaf");
  EXPECT_EQ(material.alpha_mode, render::AlphaMode::Mask);
  EXPECT_EQ(material.alpha_cutoff, 0.5F);
  EXPECT_TRUE(material.double_sided);
  EXPECT_EQ(material.base_color, glm::vec4(0.1F, 0.2F, 0.3F, 1.0F));
  EXPECT_EQ(material.metallic, 1.0F);
  EXPECT_EQ(material.roughness, 1.0F);
  EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
}

render::Image two_pixels() {
  return {2, 1, {255, 0, 0, 255, 0, 0, 255, 128}};
}

TEST(Gltf, EmbeddedTextureWithItsWrapAndTransformIsRead) {
  GltfMaker maker = triangle();
  maker.attribute<float>("TEXCOORD_1", {0, 0, 1, 0, 0, 1}, 5126, "VEC2", 2);
  maker.json["images"] = {{{"bufferView", maker.view(render::encode_png(two_pixels()))}, {"mimeType", "image/png"}}};
  maker.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33071}}};
  maker.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  const Json transform = {{"offset", {0.25, 0.5}}, {"scale", {2, 3}}};
  maker.json["materials"] = {
      {{"pbrMetallicRoughness",
        {{"baseColorTexture",
          {{"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", transform}}}}}}}}};
  maker.primitive()["material"] = 0;
  const Model model = load(maker);
  const render::TextureRef ref = model.materials[0].base_color_texture;
  ASSERT_EQ(ref.image, 0);
  EXPECT_EQ(ref.wrap, render::TextureWrap::Clamp);
  EXPECT_EQ(model.images[0].rgba, two_pixels().rgba);
  EXPECT_NEAR(model.meshes[0].vertices[1].uv.x, 2.25F, kTight);
  EXPECT_NEAR(model.meshes[0].vertices[2].uv.y, 3.5F, kTight);
}

TEST(Gltf, TextFileWithBuffersBesideAndInBase64IsRead) {
  const test::TemporaryFolder folder;
  test::write(folder / "one triangle.bin", bytes_of(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  test::write(folder / "red.png", render::encode_png(two_pixels()));
  GltfMaker maker = triangle();
  maker.json["buffers"] = {{{"byteLength", 36}, {"uri", "one%20triangle.bin"}},
                           {{"byteLength", 3}, {"uri", "data:application/octet-stream;base64,AAEC"}}};  // 0, 1, 2
  maker.json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 3}});
  maker.primitive()["indices"] = maker.accessor(1, 5121, "SCALAR", 3);
  maker.json["images"] = {{{"uri", "red.png"}}};
  maker.json["textures"] = {{{"source", 0}}};
  maker.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  maker.primitive()["material"] = 0;
  test::write(folder / "model.gltf", bytes_of(maker.json.dump()));
  const Model model = load_gltf(folder / "model.gltf");
  EXPECT_EQ(model.triangle_count(), 1U);
  ASSERT_EQ(model.images.size(), 1U);
  EXPECT_EQ(model.images[0].rgba, two_pixels().rgba);
}

TEST(Gltf, SharedBunnyAndBoxHaveTheirTriangles) {
  const std::filesystem::path folder = std::filesystem::path(SKYSHAFT_SHARED_DATA) / "models";
  if (!std::filesystem::exists(folder / "bunny.glb")) GTEST_SKIP() << "no " << folder;
  EXPECT_EQ(load_gltf(folder / "bunny.glb").triangle_count(), 5696U);
  const Model box = load_gltf(folder / "BoxTextured.glb");
  EXPECT_EQ(box.triangle_count(), 12U);
  ASSERT_EQ(box.images.size(), 1U);
  EXPECT_EQ(box.bounds_max, glm::vec3(0.5F));
}

}  // namespace
