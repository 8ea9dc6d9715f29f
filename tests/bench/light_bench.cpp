#include <GLES3/gl31.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <vector>

#include "tests/golden/light/light_rig.h"

namespace render::test {
namespace {

constexpr int kFrames = 7;

struct Times {
  double wall_ms = 0.0;
  double cpu_ms = 0.0;  // of all threads together: what a software rasteriser costs, whatever else the machine does
};

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + kFrames / 2);
  return values[kFrames / 2];
}

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
  return {median(wall_ms), median(cpu_ms)};
}

SceneState garden() {
  SceneState scene = sunny(20.0, 35.0);
  scene.sun.angular_radius_rad = 0.00465;
  scene.camera = look_at(1280, 720, {0.3, -6.0, 1.6}, {0.0, 0.0, 1.3}, 55.0);
  scene.instances = {place(make_ground(), glm::dvec3(0.0), true), load("pergola", glm::dvec3(0.0)),
                     load("plant", {0.8, -1.2, 0.0})};
  scene.medium.emplace();
  scene.medium->extinction_per_m = 0.06;
  return scene;
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
  dark.sun.illuminance_rgb = glm::dvec3(0.0);
  report("objects, no sun", median_times([&] { r.objects.draw(dark, view, r.shadow, r.models); }));
  dark.instances.resize(2);
  report("objects, no sun, pergola", median_times([&] { r.objects.draw(dark, view, r.shadow, r.models); }));
  dark.instances.resize(1);
  report("objects, real depth alone", median_times([&] { r.objects.draw(dark, view, r.shadow, r.models); }));
  const ObjectsPicture& picture = r.objects.draw(scene, view, r.shadow, r.models);
  const ShaftInputs inputs{.scene = scene, .view = view, .depth = picture.depth, .shadow = r.shadow};
  for (const int steps : {32, 64}) {
    for (const int divisor : {1, 2}) {
      const auto march = make_shaft_technique({.technique = "march", .steps = steps, .divisor = divisor});
      march->draw(inputs);
      report(fmt::format("march steps={} divisor={}", steps, divisor), median_times([&] { march->draw(inputs); }));
    }
  }
  const auto closed = make_shaft_technique({.technique = "closed-form", .divisor = 2});
  closed->draw(inputs);
  report("closed-form divisor=2", median_times([&] { closed->draw(inputs); }));
  EXPECT_GT(picture.touched.width, 0);
}

}  // namespace
}  // namespace render::test
