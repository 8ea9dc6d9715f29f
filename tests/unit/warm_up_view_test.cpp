#include "app/live/warm_up_view.h"

#include <gtest/gtest.h>

namespace {

using app::SceneFile;
using app::SceneInstance;

SceneInstance instance_of(const glm::vec3& low, const glm::vec3& high, const glm::dvec3& position_in_world) {
  auto model = std::make_shared<render::Model>();
  model->bounds_min = low;
  model->bounds_max = high;
  SceneInstance instance;
  instance.model = std::move(model);
  instance.position_in_world = position_in_world;
  return instance;
}

TEST(WarmUpView, AModelStandsWhereItsOriginIs) {
  SceneFile scene;
  scene.instances = {instance_of({-0.5F, -0.5F, 0.0F}, {0.5F, 0.5F, 3.0F}, {10.0, 0.0, 1.0})};
  scene.instances[0].scale = 2.0;
  const render::Box bounds = app::bounds_of_virtual_instances(scene);
  EXPECT_NEAR(bounds.min_in_world.z, 1.0, 1e-9) << "its foot, not its middle, is at the position";
  EXPECT_NEAR(bounds.max_in_world.z, 7.0, 1e-9);
  EXPECT_NEAR(bounds.min_in_world.x, 9.0, 1e-9);
  EXPECT_NEAR(bounds.max_in_world.x, 11.0, 1e-9);
}

TEST(WarmUpView, RealInstancesAreNotLookedAt) {
  SceneFile scene;
  scene.instances = {instance_of({-50.0F, -50.0F, 0.0F}, {50.0F, 50.0F, 1.0F}, {0.0, 0.0, 0.0}),
                     instance_of({-1.0F, -1.0F, 0.0F}, {1.0F, 1.0F, 1.0F}, {0.0, 5.0, 0.0})};
  scene.instances[0].real = true;
  const render::Box bounds = app::bounds_of_virtual_instances(scene);
  EXPECT_NEAR(bounds.max_in_world.x, 1.0, 1e-9);
  EXPECT_NEAR(bounds.min_in_world.y, 4.0, 1e-9);
}

TEST(WarmUpView, TheCameraFacesTheMiddle) {
  SceneFile scene;
  scene.instances = {instance_of({-1.0F, -1.0F, 0.0F}, {1.0F, 1.0F, 2.0F}, {3.0, 4.0, 0.0})};
  const ar::Rigid3 world_from_camera = app::pose_with_all_in_view(scene);
  const cv::Vec3d to_middle = cv::Vec3d(3.0, 4.0, 1.0) - world_from_camera.translation;
  const cv::Vec3d in_camera = world_from_camera.rotation.t() * to_middle;
  EXPECT_NEAR(in_camera[0], 0.0, 1e-9);
  EXPECT_NEAR(in_camera[1], 0.0, 1e-9);
  EXPECT_GT(in_camera[2], 1.0);
}

}  // namespace
