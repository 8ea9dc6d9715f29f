// The procedural stand-ins and the models that come with Skyshaft.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/scene/model.h"

namespace {

using render::Mesh;
using render::Model;

Model shipped(const char* name) {
  return render::load_gltf(std::filesystem::path(SKYSHAFT_SOURCE_DIR) / "data" / "models" / name);
}

// Unit normals and tangents at right angles, faces with an area, facing as their normals do.
void expect_sound(const Model& model) {
  for (const Mesh& mesh : model.meshes) {
    for (const render::Vertex& v : mesh.vertices) {
      ASSERT_NEAR(glm::length(v.normal), 1.0F, 1e-5F) << model.name;
      ASSERT_NEAR(glm::length(glm::vec3(v.tangent)), 1.0F, 1e-5F) << model.name;
      ASSERT_NEAR(glm::dot(v.normal, glm::vec3(v.tangent)), 0.0F, 1e-4F) << model.name;
      ASSERT_EQ(std::abs(v.tangent.w), 1.0F) << model.name;
      ASSERT_TRUE(std::isfinite(v.uv.x) && std::isfinite(v.uv.y)) << model.name;
    }
    int against = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const render::Vertex& a = mesh.vertices[mesh.indices[i]];
      const render::Vertex& b = mesh.vertices[mesh.indices[i + 1]];
      const render::Vertex& c = mesh.vertices[mesh.indices[i + 2]];
      const glm::vec3 face = glm::cross(b.position - a.position, c.position - a.position);
      ASSERT_GT(glm::length(face), 1e-9F) << model.name << " has a triangle without area";
      if (glm::dot(face, a.normal + b.normal + c.normal) <= 0.0F) ++against;
    }
    EXPECT_EQ(against, 0) << model.name << ": faces turned against their normals, material " << mesh.material;
  }
}

struct Expected {
  const char* file;
  std::size_t least_triangles;
  std::size_t most_triangles;
  glm::vec3 low;
  glm::vec3 high;
};

TEST(ShippedModels, HaveTheirStatedSizeAndSoundGeometry) {
  const Expected all[] = {{"pergola.glb", 4000, 8000, {-1.6F, -1.6F, 0.0F}, {1.6F, 1.6F, 2.47F}},
                          {"plant.glb", 6000, 12000, {-0.53F, -0.53F, 0.0F}, {0.53F, 0.53F, 1.58F}},
                          {"gate.glb", 800, 2000, {-0.82F, -0.08F, 0.0F}, {0.82F, 0.08F, 1.70F}},
                          {"bench.glb", 600, 1500, {-0.75F, -0.32F, 0.0F}, {0.75F, 0.37F, 0.88F}}};
  for (const Expected& expected : all) {
    const Model model = shipped(expected.file);
    EXPECT_GE(model.triangle_count(), expected.least_triangles) << expected.file;
    EXPECT_LE(model.triangle_count(), expected.most_triangles) << expected.file;
    for (int axis = 0; axis < 3; ++axis) {  // 0.1 m: rough sizes as said in models.h
      EXPECT_NEAR(model.bounds_min[axis], expected.low[axis], 0.1F) << expected.file << " axis " << axis;
      EXPECT_NEAR(model.bounds_max[axis], expected.high[axis], 0.1F) << expected.file << " axis " << axis;
    }
    EXPECT_GE(model.bounds_min.z, -0.001F) << expected.file << " must stand on the ground";
    expect_sound(model);
  }
}

TEST(ShippedModels, PostIsABareBoxOnTheGround) {
  const Model post = shipped("post.glb");
  EXPECT_EQ(post.triangle_count(), 12U);
  EXPECT_LE(glm::distance(post.bounds_min, glm::vec3(-0.05F, -0.05F, 0.0F)), 1e-6F);
  EXPECT_LE(glm::distance(post.bounds_max, glm::vec3(0.05F, 0.05F, 2.0F)), 1e-6F);
  expect_sound(post);
}

TEST(ProceduralModels, BoxAndGroundFaceOutwards) {
  const Model box = render::make_box({1.0F, 2.0F, 3.0F});
  EXPECT_EQ(box.triangle_count(), 12U);
  EXPECT_EQ(box.bounds_max, glm::vec3(0.5F, 1.0F, 1.5F));
  expect_sound(box);
  for (const render::Vertex& v : box.meshes[0].vertices) EXPECT_GT(glm::dot(v.position, v.normal), 0.0F);
  const Model ground = render::make_ground(10.0F);
  expect_sound(ground);
  EXPECT_EQ(ground.meshes[0].vertices[0].normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(ground.bounds_min, glm::vec3(-10.0F, -10.0F, 0.0F));
  EXPECT_THROW(render::make_box({1.0F, 0.0F, 1.0F}), std::runtime_error);
}

TEST(PlaceModel, HeadingTurnsClockwiseSeenFromAbove) {
  const double quarter = std::numbers::pi / 2.0;
  const glm::dmat4 world_from_model = render::place_model({10.0, 20.0, 1.0}, quarter, 2.0);
  // The model's north, 1 m away, comes to lie east at twice the distance.
  const glm::dvec3 p = glm::dvec3(world_from_model * glm::dvec4(0.0, 1.0, 0.0, 1.0));
  EXPECT_LE(glm::distance(p, glm::dvec3(12.0, 20.0, 1.0)), 1e-12);
}

}  // namespace
