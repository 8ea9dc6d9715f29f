#include "tests/bench/scenes/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace bench_scenes {
namespace {

// "About": within three parts in a hundred of the light-shaft paper's two sizes.
void expect_about(const render::Model& model, double triangles) {
  EXPECT_NEAR(static_cast<double>(model.triangle_count()), triangles, 0.03 * triangles) << model.name;
}

TEST(BenchScenes, HaveTheTrianglesOfTheLightShaftPaper) {
  expect_about(make_forest(Detail::Coarse), 66000);
  expect_about(make_forest(Detail::Fine), 188000);
  expect_about(make_gate(Detail::Coarse), 66000);
  expect_about(make_gate(Detail::Fine), 188000);
}

TEST(BenchScenes, AreTheSameEachTime) {
  const render::Model a = make_gate(Detail::Coarse);
  const render::Model b = make_gate(Detail::Coarse);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(a.meshes[i].indices, b.meshes[i].indices);
    EXPECT_TRUE(std::ranges::equal(a.meshes[i].vertices, b.meshes[i].vertices, {}, &render::Vertex::position,
                                   &render::Vertex::position));
  }
}

TEST(BenchScenes, TheGatesFinerStonesFillTheSameSpace) {
  const render::Model coarse = make_gate(Detail::Coarse);
  const render::Model fine = make_gate(Detail::Fine);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(coarse.bounds_min[i], fine.bounds_min[i], 0.05);
    EXPECT_NEAR(coarse.bounds_max[i], fine.bounds_max[i], 0.05);
  }
}

}  // namespace
}  // namespace bench_scenes
