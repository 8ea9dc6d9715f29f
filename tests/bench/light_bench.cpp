#include <GLES3/gl31.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "render/base/median.h"
#include "render/plan/screen_region.h"
#include "tests/testing/light_rig.h"

namespace render::test {
namespace {

constexpr int kFrames = 7;

struct Times {
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  // of all threads together: what a software rasteriser costs, whatever else the machine does
};

// Medians of a pass with the GPU's work waited for.
Times median_times(const std::function<void()>& pass) {
  std::vector<double> wall_ms;
  std::vector<double> cpu_ms;
  for (int i = 0; i < kFrames; ++i) {
    glFinish();
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    pass();
    glFinish();
    cpu_ms.push_back(1000.0 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
    wall_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return {upper_median(wall_ms), upper_median(cpu_ms)};
}

SceneState garden() {
  SceneState scene = sunny(20.0, 35.0);
  ensure_sun(scene).angular_radius_rad = 0.00465;
  scene.camera = look_at(1280, 720, {0.3, -6.0, 1.6}, {0.0, 0.0, 1.3}, 55.0);
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true), load("pergola", glm::dvec3(0.0)),
                     load("plant", {0.8, -1.2, 0.0})};
  scene.medium.emplace();
  scene.medium->extinction_per_m = 0.06;
  return scene;
}

Instance real_box(const glm::vec3& size_m, const glm::dvec3& middle, double heading_deg) {
  Instance box = place(make_box(size_m), middle, true);
  box.world_from_model = place_model(middle, glm::radians(heading_deg), 1.0);
  return box;
}

Instance turned(const std::string& name, const glm::dvec3& position, double heading_deg) {
  Instance instance = load(name, position);
  instance.world_from_model = place_model(position, glm::radians(heading_deg), 1.0);
  return instance;
}

// data/scenes/demo.yaml, seen as in the middle of the demo's recording.
SceneState court() {
  SceneState scene = sunny(247.83, 25.83);
  ensure_sun(scene).illuminance_rgb = glm::dvec3(74000.0);
  ensure_sun(scene).angular_radius_rad = 0.0047;
  scene.exposure = 1.0 / 13500.0;
  Camera& camera = scene.camera;
  camera.width = 1280;
  camera.height = 720;
  camera.fx = camera.fy = 1024.2;
  camera.cx = 640.0;
  camera.cy = 360.0;
  camera.world_from_camera =
      glm::translate(glm::dmat4(1.0), {4.092, 5.713, 1.593}) *
      glm::mat4_cast(glm::normalize(glm::dquat(0.204760565, -0.226687134, -0.704617969, 0.640468244)));
  scene.instances = {turned("pergola", {-0.35, -0.35, 0.0}, 30.0),
                     turned("plant", {-0.95, 0.75, 0.0}, 60.0),
                     place(make_ground(), glm::dvec3(0.0), true),
                     real_box({9.0, 0.42, 0.72}, {-3.6, -3.6, 0.36}, 45.0),
                     real_box({9.1, 0.52, 0.07}, {-3.6, -3.6, 0.755}, 45.0),
                     real_box({0.55, 0.55, 0.50}, {1.98, -2.26, 0.25}, 20.0),
                     real_box({1.5, 0.45, 0.42}, {-3.04, 1.63, 0.21}, 60.0)};
  return scene;
}

// Much as data/scenes/demo.yaml: smoke under a roof, occluders of both kinds.
SceneState demo() {
  SceneState scene = sunny(247.8, 25.8);
  scene.camera = look_at(1280, 720, {3.91, 5.81, 1.6}, {-0.35, -0.35, 1.1}, 38.7);
  Instance pergola = load("pergola", {-0.35, -0.35, 0.0});
  pergola.world_from_model = place_model({-0.35, -0.35, 0.0}, 303.0, 1.0);
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true), std::move(pergola), load("plant", {-0.95, 0.75, 0.0}),
                     place(make_box({0.55, 0.55, 0.5}), {1.98, -2.26, 0.25}, true),
                     place(make_box({1.5, 0.45, 0.42}), {-3.04, 1.63, 0.21}, true)};
  scene.medium.emplace();
  scene.medium->extinction_per_m = 2.996 / 23.0;
  scene.medium->albedo = 0.9;
  scene.medium->g = 0.6;
  scene.medium->extent = Box{{-2.4, -2.4, 0.0}, {1.7, 1.7, 2.42}};
  return scene;
}

double relative_rmse(const Pixels& found, const Pixels& truth) {
  double error = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < truth.rgba.size(); ++i) {
    const double d = found.rgba[i].r - truth.rgba[i].r;
    error += d * d;
    total += static_cast<double>(truth.rgba[i].r) * truth.rgba[i].r;
  }
  return std::sqrt(error / total);
}

void report(const std::string& name, const Times& times) {
  fmt::print("{:32} {:8.2f} ms wall, {:8.2f} ms of processor time\n", name, times.wall_ms, times.cpu_ms);
}

TEST(LightBench, MedianOfEachPassAt1280x720) {
  SceneState scene = garden();
  const View view = pinhole_view(scene.camera);
  LightRig& r = rig();
  const LightPictures pictures = r.render(scene);
  dump(pictures, "garden");
  report("shadow map 2048", median_times([&] {
           scene.instances[1].world_from_model[3].x += 1e-4;  // something moved
           r.shadow.update(scene, view, 2048, r.models);
         }));
  report("shadow map 2048, still", median_times([&] { r.shadow.update(scene, view, 2048, r.models); }));
  report("objects", median_times([&] { r.objects.draw(scene, view, r.shadow, r.models); }));
  SceneState dark = scene;
  ensure_sun(dark).illuminance_rgb = glm::dvec3(0.0);
  report("objects, no sun", median_times([&] { r.objects.draw(dark, view, r.shadow, r.models); }));
  dark.instances.resize(2);
  report("objects, no sun, pergola", median_times([&] { r.objects.draw(dark, view, r.shadow, r.models); }));
  dark.instances.resize(1);
  report("objects, real depth alone", median_times([&] { r.objects.draw(dark, view, r.shadow, r.models); }));
  const ObjectsPicture& picture = r.objects.draw(scene, view, r.shadow, r.models);
  const ShaftInputs inputs{.scene = scene, .view = view, .depth = picture.depth, .shadow = r.shadow};
  for (const int steps : {32, 64}) {
    for (const int divisor : {1, 2}) {
      const auto march =
          make_shaft_technique({.technique = "interleaved", .parameters = {{"steps", steps}, {"divisor", divisor}}});
      march->draw(inputs);
      report(fmt::format("march steps={} divisor={}", steps, divisor), median_times([&] { march->draw(inputs); }));
    }
  }
  const auto closed = make_shaft_technique({.technique = "closed-form", .parameters = {{"divisor", 2}}});
  closed->draw(inputs);
  report("closed-form divisor=2", median_times([&] { closed->draw(inputs); }));
  EXPECT_GT(picture.touched.width, 0);
}

TEST(LightBench, TheDemosObjectsAt1280x720) {
  SceneState scene = court();
  const View view = pinhole_view(scene.camera);
  LightRig& r = rig();
  dump(r.render(scene), "court");
  const auto objects = [&] { r.objects.draw(scene, view, r.shadow, r.models); };
  report("court: objects", median_times(objects));
  ObjectsPass plain(1);
  report("court: objects, no anti-aliasing", median_times([&] { plain.draw(scene, view, r.shadow, r.models); }));
  const std::vector<Instance> all = scene.instances;
  scene.instances.erase(scene.instances.begin() + 2, scene.instances.end());
  r.shadow.update(scene, view, 2048, r.models);
  report("court: virtual things alone", median_times(objects));
  scene.instances.erase(scene.instances.begin());
  report("court: plant alone", median_times(objects));
  scene.instances = all;
  ensure_sun(scene).illuminance_rgb = glm::dvec3(0.0);
  report("court: objects, no sun", median_times(objects));
  report("court: objects, no sun, no anti-aliasing",
         median_times([&] { plain.draw(scene, view, r.shadow, r.models); }));
}

// The error is that of the scattered light alone, against 1024 steps at the same size.
TEST(LightBench, MarchOfTheDemoAt1280x720) {
  const SceneState scene = demo();
  const View view = pinhole_view(scene.camera);
  LightRig& r = rig();
  r.shadow.update(scene, view, 2048, r.models);
  const ObjectsPicture& picture = r.objects.draw(scene, view, r.shadow, r.models);
  const PixelRect seen = medium_region(view, *scene.medium);
  const ShaftInputs inputs{.scene = scene,
                           .view = view,
                           .depth = picture.depth,
                           .shadow = r.shadow,
                           .region_px = {seen.x, seen.y, seen.width, seen.height}};
  for (const int divisor : {2, 3}) {
    const auto fine =
        make_shaft_technique({.technique = "interleaved", .parameters = {{"steps", 1024}, {"divisor", divisor}}});
    const ShaftPicture& truth_picture = fine->draw(inputs);
    const Pixels truth = read_pixels(truth_picture.texture, truth_picture.width, truth_picture.height, GL_FLOAT);
    for (const int steps : {16, 32, 64}) {
      const auto march =
          make_shaft_technique({.technique = "interleaved", .parameters = {{"steps", steps}, {"divisor", divisor}}});
      const ShaftPicture& drawn = march->draw(inputs);
      const double error = relative_rmse(read_pixels(drawn.texture, drawn.width, drawn.height, GL_FLOAT), truth);
      report(fmt::format("demo steps={} divisor={} error={:.4f}", steps, divisor, error),
             median_times([&] { march->draw(inputs); }));
      EXPECT_LT(error, 0.05);
    }
  }
  const auto closed = make_shaft_technique({.technique = "closed-form", .parameters = {{"divisor", 2}}});
  closed->draw(inputs);
  report("demo closed-form divisor=2", median_times([&] { closed->draw(inputs); }));
}

}  // namespace
}  // namespace render::test
