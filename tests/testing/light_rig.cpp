#include "tests/testing/light_rig.h"

#include <GLES3/gl31.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/constants.hpp>

#include "render/gl/error.h"
#include "render/images/image_io.h"

namespace render::test {

Pixels read_pixels(GLuint texture, int width, int height, GLenum type) {
  GLuint framebuffer = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  Pixels out{width, height, std::vector<glm::vec4>(static_cast<std::size_t>(width * height))};
  if (type == GL_FLOAT) {
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, out.rgba.data());
  } else {
    std::vector<std::uint32_t> words(out.rgba.size());
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV, words.data());
    for (std::size_t i = 0; i < words.size(); ++i) {
      const auto channel = [&](unsigned shift) { return static_cast<float>((words[i] >> shift) & 1023U) / 1023.0F; };
      out.rgba[i] = {channel(0), channel(10), channel(20), 1.0F};
    }
  }
  glDeleteFramebuffers(1, &framebuffer);
  gl::check_errors("reading a picture back");
  return out;
}

LightPictures LightRig::render(const SceneState& scene, const ShaftSettings& settings, int shadow_map_size) {
  const View view = pinhole_view(scene.camera);
  LightPictures out;
  out.shadow_was_rendered = shadow.update(scene, view, shadow_map_size, models);
  const ObjectsPicture& picture = objects.draw(scene, view, shadow, models);
  if (scene.medium) {
    const ShaftInputs inputs{.scene = scene, .view = view, .depth = picture.depth, .shadow = shadow};
    const ShaftPicture* shafts = &technique(settings).draw(inputs);
    const bool tinted =
        find_shaft_technique(settings.technique)->handles_translucency || shadow.translucent().fit.empty;
    if (!tinted) shafts = &tint.draw(inputs, *shafts);
    out.shafts = read_pixels(shafts->texture, shafts->width, shafts->height, GL_FLOAT);
    out.distance = read_pixels(shafts->distance, shafts->width, shafts->height, GL_FLOAT);
  }
  out.added = read_pixels(picture.added, picture.width, picture.height, GL_FLOAT);
  out.multiplier = read_pixels(picture.multiplier, picture.width, picture.height, GL_UNSIGNED_INT_2_10_10_10_REV);
  gl::check_errors("light rig");
  return out;
}

ShaftTechnique& LightRig::technique(const ShaftSettings& settings) {
  std::unique_ptr<ShaftTechnique>& made = techniques_[to_text(settings)];
  if (!made) made = make_shaft_technique(settings);
  return *made;
}

LightRig& rig() {
  static LightRig instance;
  return instance;
}

double relative_rmse(const Pixels& found, const std::vector<glm::vec4>& truth, double exposure) {
  double error = 0.0;
  double total = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const glm::dvec3 expected = exposure * glm::dvec3(truth[i]);
    const glm::dvec3 off = glm::dvec3(found.rgba[i]) - expected;
    error += glm::dot(off, off);
    total += glm::dot(expected, expected);
  }
  return std::sqrt(error / total);
}

Camera look_at(int width, int height, const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov_deg,
               const glm::dvec3& up) {
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = 0.5 * height / std::tan(0.5 * glm::radians(vertical_fov_deg));
  camera.cx = 0.5 * width;
  camera.cy = 0.5 * height;
  camera.world_from_camera = glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(glm::cross(forward, right), 0.0),
                                        glm::dvec4(forward, 0.0), glm::dvec4(eye, 1.0));
  return camera;
}

glm::dvec3 sun_direction(double azimuth_deg, double elevation_deg) {
  const double az = glm::radians(azimuth_deg);
  const double el = glm::radians(elevation_deg);
  return {std::sin(az) * std::cos(el), std::cos(az) * std::cos(el), std::sin(el)};
}

Instance place(Model model, const glm::dvec3& position_in_world, bool real) {
  return {.name = model.name,
          .model = std::make_shared<const Model>(std::move(model)),
          .world_from_model = place_model(position_in_world, 0.0, 1.0),
          .real = real};
}

Instance load(const std::string& name, const glm::dvec3& position_in_world) {
  return place(load_gltf(std::filesystem::path(SKYSHAFT_SOURCE_DIR) / "data/models" / (name + ".glb")),
               position_in_world, false);
}

Model sealed_room() {
  Model room = make_box({6.0F, 6.0F, 3.0F});
  for (Material& material : room.materials) material.double_sided = true;
  return room;
}

float brightest(const Pixels& picture) {
  float most = 0.0F;
  for (const glm::vec4& p : picture.rgba) most = std::max({most, p.r, p.g, p.b});
  return most;
}

SceneState sunny(double azimuth_deg, double elevation_deg, double sky_luminance) {
  SceneState scene;
  ensure_sun(scene).direction_in_world = sun_direction(azimuth_deg, elevation_deg);
  ensure_sun(scene).illuminance_rgb = glm::dvec3(90000.0);
  scene.sky_light.radiance_sh[0] = glm::dvec3(sky_luminance * std::sqrt(4.0 * glm::pi<double>()));
  scene.sky_light.horizontal_illuminance_rgb = glm::dvec3(sky_luminance * glm::pi<double>());
  scene.exposure = 1.0 / 30000.0;
  return scene;
}

void dump(const LightPictures& pictures, const std::string& name, float grey) {
  const char* folder = std::getenv("SKYSHAFT_PICTURES");
  if (folder == nullptr) return;
  const Pixels& added = pictures.added;
  Image image{added.width, added.height, {}};
  for (int y = 0; y < added.height; ++y) {
    for (int x = 0; x < added.width; ++x) {
      glm::vec3 color = grey * glm::vec3(pictures.multiplier.at(x, y)) + glm::vec3(added.at(x, y));
      if (pictures.shafts.width > 0) {
        const int divisor = (added.width + pictures.shafts.width - 1) / pictures.shafts.width;
        const glm::vec4 shaft = pictures.shafts.at(x / divisor, y / divisor);
        color = color * shaft.a + glm::vec3(shaft);
      }
      for (int i = 0; i < 3; ++i) {
        const float c = std::min(std::max(color[i], 0.0F), 1.0F);
        const float encoded = c < 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
        image.rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0F * encoded)));
      }
      image.rgba.push_back(255);
    }
  }
  write_png(std::filesystem::path(folder) / (name + ".png"), image);
}

}  // namespace render::test
