// bench_shafts FOLDER SCENE WxH [eye=X,Y,Z] [target=X,Y,Z] [sun=AZIMUTH,ELEVATION] [TECHNIQUE[:key=value,...]...]: time
// of the shaft pass and error against the reference on a scene that skyshaft-bench-scenes wrote to FOLDER, from its own
// view and under its own sun unless others are given (metres, degrees). The camera moves and the shadow maps, the
// medium's too where the technique gains by it, are drawn again each frame: what that takes ("medium map") is not part
// of the pass.
#include <GLES3/gl31.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <vector>

#include "render/base/median.h"
#include "render/images/image_io.h"
#include "render/shadow/cascades.h"
#include "render/shafts/reference/shaft_reference.h"
#include "tests/testing/light_rig.h"

namespace render::test {
namespace {

constexpr int kFrames = 7;

int map_size() {
  const char* text = std::getenv("SHADOW_MAP_SIZE");
  return text == nullptr ? 2048 : std::atoi(text);
}

// Where the scene is seen from and lit from.
struct Setting {
  glm::dvec3 eye{-2.6, 2.6, 1.6};
  glm::dvec3 target{0.6, -1.2, 1.05};
  double fov_deg = 56.0;
  glm::dvec2 sun_deg{160.0, 38.0};  // azimuth, elevation

  // The scene's own.
  explicit Setting(const std::string& name) {
    if (name.starts_with("gate")) {
      eye = {2.1, -10.8, 1.5};
      target = {-0.35, 0.0, 2.7};
      fov_deg = 46.0;
      sun_deg = {343.0, 26.0};
    } else if (name.starts_with("forest")) {
      eye = {0.6, -13.5, 1.7};
      target = {-0.4, 0.0, 4.6};
      fov_deg = 52.0;
      sun_deg = {14.0, 43.0};
    }
  }

  // Whether the text is one of what main() may be given instead, and nothing more.
  bool take(const char* text) {
    char more = 0;
    return std::sscanf(text, "eye=%lf,%lf,%lf%c", &eye.x, &eye.y, &eye.z, &more) == 3 ||
           std::sscanf(text, "target=%lf,%lf,%lf%c", &target.x, &target.y, &target.z, &more) == 3 ||
           std::sscanf(text, "sun=%lf,%lf%c", &sun_deg.x, &sun_deg.y, &more) == 2;
  }

  std::string name() const {
    return fmt::format("eye {:g} {:g} {:g}, target {:g} {:g} {:g}, sun {:g} {:g}", eye.x, eye.y, eye.z, target.x,
                       target.y, target.z, sun_deg.x, sun_deg.y);
  }
};

SceneState scene_of(const std::filesystem::path& folder, const std::string& name, const Setting& setting) {
  const auto starts = [&](const char* word) { return name.starts_with(word); };
  SceneState scene = sunny(setting.sun_deg.x, setting.sun_deg.y, starts("room") ? 0.0 : 6000.0);
  ensure_sun(scene).illuminance_rgb = glm::dvec3(starts("room") ? 80000.0 : 260000.0);
  scene.exposure = 1.0 / (starts("gate") ? 34000.0 : starts("forest") ? 32000.0 : 3800.0);
  scene.medium.emplace();
  scene.medium->extinction_per_m = starts("gate") ? 0.025 : starts("forest") ? 0.028 : 0.09;
  scene.medium->g = starts("room") ? 0.5 : 0.6;
  if (starts("forest")) scene.medium->extent = Box{{-14, -15, -1}, {14, 14, 15}};
  if (starts("room")) scene.medium->extent = Box{{-3, -2.5, 0}, {3, 3, 3}};
  scene.instances = {place(load_gltf(folder / (name + ".glb")), glm::dvec3(0.0), false)};
  return scene;
}

// Medians.
struct Times {
  double cascades_ms = 0.0;
  double wall_ms = 0.0;
  double cpu_ms = 0.0;
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Bench {
  std::filesystem::path folder;
  std::string name;
  std::string setting;
  SceneState scene;
  View view;
  const ObjectsPicture* objects = nullptr;
  LightPictures pictures;  // added, multiplier
  std::vector<float> axis_m;
  std::vector<glm::vec4> truth;  // exposed

  void draw_objects() {
    view = pinhole_view(scene.camera);
    rig().shadow.update(scene, view, map_size(), rig().models);
    objects = &rig().objects.draw(scene, view, rig().shadow, rig().models);
  }
  ShaftInputs inputs() const { return {.scene = scene, .view = view, .depth = objects->depth, .shadow = rig().shadow}; }

  void make_truth() {
    draw_objects();
    pictures.added = read_pixels(objects->added, view.width, view.height, GL_FLOAT);
    pictures.multiplier = read_pixels(objects->multiplier, view.width, view.height, GL_UNSIGNED_INT_2_10_10_10_REV);
    const auto open = make_shaft_technique(parse_shaft_settings("closed-form:divisor=1"));
    const ShaftPicture& distance = open->draw(inputs());
    for (const glm::vec4& p : read_pixels(distance.distance, view.width, view.height, GL_FLOAT).rgba)
      axis_m.push_back(p.r);
    const auto cache = folder / fmt::format("{}-{}x{} {}.truth", name, view.width, view.height, setting);
    truth.resize(axis_m.size());
    std::ifstream in(cache, std::ios::binary);
    if (!in.read(reinterpret_cast<char*>(truth.data()),
                 static_cast<std::streamsize>(truth.size() * sizeof(glm::vec4)))) {
      const ShaftReference reference(scene, {.sky = ReferenceSky::Open});
      truth = reference.picture(view, axis_m).rgba;
      for (glm::vec4& p : truth) p = glm::vec4(glm::vec3(p) * static_cast<float>(scene.exposure), p.a);
      std::ofstream(cache, std::ios::binary)
          .write(reinterpret_cast<const char*>(truth.data()),
                 static_cast<std::streamsize>(truth.size() * sizeof(glm::vec4)));
    }
  }

  std::uint8_t shown(std::size_t i, int channel, const glm::vec4& medium) const {
    const float behind = 0.3F * pictures.multiplier.rgba[i][channel] + pictures.added.rgba[i][channel];
    const float c = std::clamp(behind * medium.a + medium[channel], 0.0F, 1.0F);
    return static_cast<std::uint8_t>(
        std::lround(255.0F * (c < 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F)));
  }

  void compare(const std::string& settings, const Times& times, const Pixels& found) const {
    double error = 0.0;
    double total = 0.0;
    double squares = 0.0;
    std::size_t off = 0;
    Image picture{view.width, view.height, {}};
    Image difference{view.width, view.height, {}};
    const int divisor = (view.width + found.width - 1) / found.width;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const int x = static_cast<int>(i) % view.width / divisor;
      const int y = static_cast<int>(i) / view.width / divisor;
      const glm::vec4& medium = found.at(x, y);
      error += std::pow(medium.r - truth[i].r, 2.0);
      total += std::pow(truth[i].r, 2.0);
      int worst = 0;
      for (int c = 0; c < 3; ++c) {
        const std::uint8_t a = shown(i, c, medium);
        const std::uint8_t b = shown(i, c, truth[i]);
        squares += (a - b) * (a - b) / 3.0;
        worst = std::max(worst, std::abs(a - b));
        picture.rgba.push_back(a);
        difference.rgba.push_back(static_cast<std::uint8_t>(std::clamp(128 + 16 * (a - b), 0, 255)));
      }
      picture.rgba.push_back(255);
      difference.rgba.push_back(255);
      off += worst > 2 ? 1 : 0;
    }
    const auto count = static_cast<double>(truth.size());
    fmt::print(
        "{:60} medium map {:6.1f} ms  {:8.1f} ms wall {:8.1f} ms cpu  PSNR {:6.2f}  >2: {:6.3f} %  RMSE {:.5f}\n",
        settings, times.cascades_ms, times.wall_ms, times.cpu_ms,
        10.0 * std::log10(255.0 * 255.0 / std::max(squares / count, 1e-9)), 100.0 * static_cast<double>(off) / count,
        std::sqrt(error / total));
    std::fflush(stdout);
    if (const char* to = std::getenv("SKYSHAFT_PICTURES")) {
      std::string file = settings;
      std::ranges::replace(file, ':', '_');
      write_png(std::filesystem::path(to) / (name + "_" + file + ".png"), picture);
      write_png(std::filesystem::path(to) / (name + "_" + file + "_diff.png"), difference);
    }
  }

  void run(const std::string& settings) {
    const ShaftSettings parsed = parse_shaft_settings(settings);
    const auto technique = make_shaft_technique(parsed);
    const bool gains = find_shaft_technique(parsed.technique)->limited_by_shadow_resolution;
    CascadedShadow medium;
    std::vector<double> map;
    std::vector<double> wall;
    std::vector<double> cpu;
    const glm::dmat4 still = scene.camera.world_from_camera;
    const glm::dmat4 occluder = scene.instances[0].world_from_model;
    Pixels found;
    for (int i = 0; i <= kFrames; ++i) {
      const double moved = 0.003 * (kFrames - i);  // the last frame is where the truth is
      scene.camera.world_from_camera[3].x = still[3].x + moved;
      scene.instances[0].world_from_model[3].x = occluder[3].x + 1e-7 * (kFrames - i);
      draw_objects();
      glFinish();
      const auto map_start = std::chrono::steady_clock::now();
      const std::span<const Cascade> parts =
          gains ? medium.update(rig().shadow, scene, view, objects->depth, rig().models) : std::span<const Cascade>{};
      glFinish();
      if (i > 0) map.push_back(milliseconds_since(map_start));
      const auto start = std::chrono::steady_clock::now();
      const std::clock_t cpu_start = std::clock();
      ShaftInputs asked = inputs();
      asked.medium = parts;
      asked.with_distance = false;  // as the program has it
      const ShaftPicture& picture = technique->draw(asked);
      glFinish();
      if (i > 0) cpu.push_back(1000.0 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
      if (i > 0) wall.push_back(milliseconds_since(start));
      if (i == kFrames) found = read_pixels(picture.texture, picture.width, picture.height, GL_FLOAT);
    }
    compare(settings, {upper_median(map), upper_median(wall), upper_median(cpu)}, found);
  }
};

}  // namespace
}  // namespace render::test

int main(int argc, char** argv) {
  using namespace render;
  using namespace render::test;
  if (argc < 4) {
    std::fputs("usage: bench_shafts FOLDER SCENE WxH [eye=X,Y,Z] [target=X,Y,Z] [sun=AZ,EL] [TECHNIQUE...]\n", stderr);
    return 2;
  }
  try {
    glm::ivec2 size;
    if (std::sscanf(argv[3], "%dx%d", &size.x, &size.y) != 2) throw std::runtime_error("the size must be WxH");
    rig();
    Bench bench;
    bench.folder = argv[1];
    bench.name = argv[2];
    Setting setting(bench.name);
    int first = 4;
    while (first < argc && setting.take(argv[first])) ++first;
    bench.setting = setting.name();
    bench.scene = scene_of(bench.folder, bench.name, setting);
    bench.scene.camera = look_at(size.x, size.y, setting.eye, setting.target, setting.fov_deg);
    bench.make_truth();
    const glm::dvec3 map_m = rig().shadow.map(Occluders::Virtual).fit.metres_per_unit;
    fmt::print("{} at {}, {}: {} triangles, shadow map {:.1f} x {:.1f} m, {:.1f} m deep\n", bench.name, argv[3],
               bench.setting, bench.scene.instances[0].model->triangle_count(), map_m.x, map_m.y, map_m.z);
    for (int i = first; i < argc; ++i) bench.run(argv[i]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_shafts: {}\n", error.what());
    return 1;
  }
  return 0;
}
