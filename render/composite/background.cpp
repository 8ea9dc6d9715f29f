#include "render/composite/background.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <optional>
#include <thread>
#include <vector>

#include "render/sky/sky_model.h"

namespace render {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Ideal coordinates at a pixel's centre.
std::optional<glm::dvec2> ideal_at(const Camera& camera, int x, int y) {
  if (!camera.lens) {
    return (glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(camera.cx, camera.cy)) / glm::dvec2(camera.fx, camera.fy);
  }
  const glm::vec2 ideal =
      camera.lens
          ->ideal[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width) + static_cast<std::size_t>(x)];
  if (!std::isfinite(ideal.x) || !std::isfinite(ideal.y)) return std::nullopt;
  return glm::dvec2(ideal);
}

class Background {
 public:
  explicit Background(const SceneState& scene)
      : scene_(scene),
        world_from_camera_(scene.camera.world_from_camera),
        sun_(sun_of(scene)),
        sun_direction_(glm::normalize(sun_.direction_in_world)),
        pixel_angle_rad_(scene.camera.lens ? 1.0 / scene.camera.width : 1.0 / scene.camera.fx) {
    const double radius = sun_.angular_radius_rad;
    if (radius > 0.0) disc_luminance_rgb_ = sun_.illuminance_rgb / (kPi * std::sin(radius) * std::sin(radius));
  }

  glm::vec3 at(int x, int y) const {
    const std::optional<glm::dvec2> ideal = ideal_at(scene_.camera, x, y);
    if (!ideal) return glm::vec3(0.0F);
    const glm::dvec3 direction = glm::normalize(world_from_camera_ * glm::dvec3(*ideal, 1.0));
    glm::dvec3 light(0.0);
    if (scene_.sky) light = scene_.sky->luminance_rgb(direction);
    return glm::vec3(light + disc_coverage(direction) * disc_luminance_rgb_);
  }

 private:
  // The part of a pixel that the sun's disc covers, as if its rim were straight.
  double disc_coverage(const glm::dvec3& direction) const {
    if (sun_.angular_radius_rad <= 0.0) return 0.0;
    // atan2 is accurate for tiny angles, where acos is not.
    const double angle =
        std::atan2(glm::length(glm::cross(direction, sun_direction_)), glm::dot(direction, sun_direction_));
    return std::clamp((sun_.angular_radius_rad - angle) / pixel_angle_rad_ + 0.5, 0.0, 1.0);
  }

  const SceneState& scene_;
  glm::dmat3 world_from_camera_;
  const Sun& sun_;
  glm::dvec3 sun_direction_;
  double pixel_angle_rad_;
  glm::dvec3 disc_luminance_rgb_{0.0};
};

}  // namespace

LinearImage sky_background(const SceneState& scene) {
  LinearImage image{scene.camera.width, scene.camera.height, {}};
  image.rgb.assign(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), glm::vec3(0.0F));
  if (!scene.sky && sun_of(scene).angular_radius_rad <= 0.0) return image;
  const Background background(scene);
  const int workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::future<void>> running;
  for (int worker = 0; worker < workers; ++worker) {
    running.push_back(std::async(std::launch::async, [&image, &background, worker, workers] {
      for (int y = worker; y < image.height; y += workers) {
        glm::vec3* row = image.rgb.data() + static_cast<std::ptrdiff_t>(y) * image.width;
        for (int x = 0; x < image.width; ++x) row[x] = background.at(x, y);
      }
    }));
  }
  for (std::future<void>& worker : running) worker.get();
  return image;
}

}  // namespace render
