// Convex parts of models, and the shadow maps that leave them out.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "render/scene/model.h"
#include "render/shadow/shadow_fit.h"

namespace render {
namespace {

void append(Model& model, const Model& part, const glm::vec3& by) {
  if (model.meshes.empty()) {
    model = part;
    model.meshes.front().vertices.clear();
    model.meshes.front().indices.clear();
  }
  Mesh& mesh = model.meshes.front();
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (Vertex vertex : part.meshes.front().vertices) {
    vertex.position += by;
    mesh.vertices.push_back(vertex);
  }
  for (const std::uint32_t index : part.meshes.front().indices) mesh.indices.push_back(first + index);
}

void finish(Model& model) {
  model.bounds_min = glm::vec3(std::numeric_limits<float>::infinity());
  model.bounds_max = -model.bounds_min;
  for (const Vertex& vertex : model.meshes.front().vertices) {
    model.bounds_min = glm::min(model.bounds_min, vertex.position);
    model.bounds_max = glm::max(model.bounds_max, vertex.position);
  }
  model.convex_pieces = find_convex_pieces(model);
}

// A slab 20 m across whose top is at 0, and a post 3 m high in its middle, in one mesh.
Model post_on_slab() {
  Model model;
  append(model, make_box({20, 20, 0.5F}), {0, 0, -0.25F});
  append(model, make_box({0.4F, 0.4F, 3}), {0, 0, 1.5F});
  finish(model);
  return model;
}

TEST(ConvexPiece, ASlabIsFoundAndTheSmallPostOnItIsNot) {
  const Model model = post_on_slab();
  ASSERT_EQ(model.convex_pieces.size(), 1U);
  const ConvexPiece& slab = model.convex_pieces.front();
  EXPECT_EQ(slab.triangles.size(), 12U);
  EXPECT_EQ(slab.vertices.size(), 24U);
  EXPECT_FALSE(slab.flat);
}

TEST(ConvexPiece, ASheetIsFoundAndAnAngleOfTwoIsNot) {
  EXPECT_TRUE(make_ground(5.0F).convex_pieces.at(0).flat);
  Model angle;
  append(angle, make_ground(5.0F), {0, 0, 0});
  append(angle, make_ground(5.0F), {10, 0, 0});
  finish(angle);
  EXPECT_EQ(angle.convex_pieces.size(), 1U) << "two sheets edge to edge are one";
  append(angle, make_ground(5.0F), {10, 10, 0});
  finish(angle);
  EXPECT_TRUE(angle.convex_pieces.empty());
}

// What comes and goes with every step of the eye would make the map's texels jump.
TEST(ConvexPiece, ABeamIsNotLargeHoweverLongItIs) {
  EXPECT_TRUE(make_box({8, 0.2F, 0.2F}).convex_pieces.empty());
  EXPECT_EQ(make_box({8, 4, 0.2F}).convex_pieces.size(), 1U);
}

TEST(ConvexPiece, AnOpenBoxAndATransparentOneAreNot) {
  Model open = make_box({2, 2, 2});
  open.meshes.front().indices.resize(open.meshes.front().indices.size() - 6);
  EXPECT_TRUE(find_convex_pieces(open).empty());
  Model leaf = make_box({2, 2, 2});
  leaf.materials.front().alpha_mode = AlphaMode::Mask;
  EXPECT_TRUE(find_convex_pieces(leaf).empty());
}

TEST(ConvexPiece, ARayMeetsItFromOutsideOnly) {
  const Model box = make_box({2, 2, 2});
  const ConvexPiece& piece = box.convex_pieces.at(0);
  EXPECT_TRUE(meets(piece, {0.3, 0.2, 5}, {0, 0, -2}));
  EXPECT_FALSE(meets(piece, {0.3, 0.2, 5}, {0, 0, 2}));
  EXPECT_FALSE(meets(piece, {1.3, 0.2, 5}, {0, 0, -2}));
  EXPECT_FALSE(meets(piece, {0.3, 0.2, 0.5}, {0, 0, -2})) << "from inside";
}

struct Fitted {
  ShadowFit fit;
  std::size_t left_out = 0;
};

Fitted fit_for(const glm::dvec3& eye) {
  SceneState scene;
  scene.instances.push_back({"post", std::make_shared<const Model>(post_on_slab()), glm::dmat4(1.0), false});
  ensure_sun(scene).direction_in_world = glm::normalize(glm::dvec3(1, 0, 1));
  scene.camera.world_from_camera[3] = glm::dvec4(eye, 1.0);
  View view = pinhole_view(scene.camera);
  const auto all = occluders(scene, Occluders::Virtual);
  const auto out = pieces_before_their_shadow(all, sun_of(scene).direction_in_world, eye);
  return {fit_shadow(scene, view, all, 1024, FitTo::Occluders, out), out.size()};
}

TEST(ShadowFit, MapsOfAnySizeAreFiniteAndHoldTheirOccluders) {
  SceneState scene;
  scene.instances.push_back({"post", std::make_shared<const Model>(post_on_slab()), glm::dmat4(1.0), false});
  ensure_sun(scene).direction_in_world = glm::normalize(glm::dvec3(1, 0, 1));
  const View view = pinhole_view(scene.camera);
  const auto all = occluders(scene, Occluders::Virtual);
  for (const int size_px : {1, 2, 6, 7, 8, 64, 8192}) {
    const ShadowFit fit = fit_shadow(scene, view, all, size_px);
    const glm::dvec3 top(fit.map_from_world * glm::dvec4(0, 0, 3, 1));  // the post's
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GT(fit.metres_per_unit[axis], 0.0) << size_px;
      EXPECT_TRUE(std::isfinite(top[axis])) << size_px;
      if (size_px < 6) continue;  // places are whole texels: of so few, the occluders may lie beside them
      EXPECT_GE(top[axis], 0.0) << size_px;
      EXPECT_LE(top[axis], 1.0) << size_px;
    }
  }
}

// The shadow of an eye over the slab falls on it. All that the slab shades is then behind it.
TEST(ShadowFit, TheGroundThatTheEyeStandsOnTakesNoTexels) {
  const Fitted over = fit_for({-4, -4, 1.7});
  EXPECT_EQ(over.left_out, 1U);
  // The post is 3 m high and 0.4 m across, seen at 45 degrees, in a map that is turned against it.
  EXPECT_LT(over.fit.metres_per_unit.x, 3.2);
  EXPECT_LT(over.fit.metres_per_unit.y, 3.2);
  const Fitted below = fit_for({-4, -4, -1.7});
  EXPECT_EQ(below.left_out, 0U) << "an eye in the slab's shade sees it";
  EXPECT_GT(below.fit.metres_per_unit.x, 14.0);
  const Fitted beside = fit_for({-11, 0, 1.7});
  EXPECT_EQ(beside.left_out, 0U) << "and so may one past its edge";
}

}  // namespace
}  // namespace render
