#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/gl/context.h"
#include "render/shafts/shaft_technique.h"
#include "render/shafts/translucent_tint.h"
#include "render/surface/objects_pass.h"

namespace render::test {

// A picture read back from the GPU, row 0 at the top.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> rgba;

  const glm::vec4& at(int x, int y) const { return rgba[static_cast<std::size_t>(y * width + x)]; }
  bool operator==(const Pixels&) const = default;
};

struct LightPictures {
  Pixels added;
  Pixels multiplier;
  Pixels shafts;
  Pixels distance;  // r: metres along the axis
  bool shadow_was_rendered = false;
};

// Shadow maps, objects and shafts of one scene after the other, on one context.
class LightRig {
 public:
  // The view is the scene's own camera, which has no lens. Shafts only where the scene has a medium, tinted by its
  // translucent occluders.
  LightPictures render(const SceneState& scene, const ShaftSettings& shafts = {.technique = "interleaved"},
                       int shadow_map_size = 2048);

  // Made when first asked for: compiling shaders takes a while.
  ShaftTechnique& technique(const ShaftSettings& settings);

  gl::Context context;
  GpuModels models;
  SunShadow shadow;
  ObjectsPass objects{4};
  TranslucentTint tint;

 private:
  std::map<std::string, std::unique_ptr<ShaftTechnique>> techniques_;
};

// One for the whole test program: making a context and compiling shaders takes a while.
LightRig& rig();

Pixels read_pixels(GLuint texture, int width, int height, GLenum type);

// Of the colours alone: RMS of the differences from `truth` * exposure over RMS of that.
double relative_rmse(const Pixels& found, const std::vector<glm::vec4>& truth, double exposure = 1.0);

// A camera of that size at `eye` looking at `target`, vertical field of view in degrees. `up` is not along the view.
Camera look_at(int width, int height, const glm::dvec3& eye, const glm::dvec3& target, double vertical_fov_deg,
               const glm::dvec3& up = {0.0, 0.0, 1.0});

glm::dvec3 sun_direction(double azimuth_deg, double elevation_deg);

Instance place(Model model, const glm::dvec3& position_in_world, bool real);
Instance load(const std::string& name, const glm::dvec3& position_in_world);  // data/models/NAME.glb, virtual

// A sealed room of 6 x 6 x 3 m around the origin, with walls that are seen from within.
Model sealed_room();
// The largest of the three colours of any pixel.
float brightest(const Pixels& picture);

// Sun of 90,000 lux at white, sky SH of a uniform sky of that luminance, and exposure for it.
SceneState sunny(double azimuth_deg, double elevation_deg, double sky_luminance = 4000.0);

// Where SKYSHAFT_PICTURES is set: writes (grey * M + A) * T + L as sRGB to that folder, to be looked at.
void dump(const LightPictures& pictures, const std::string& name, float grey = 0.5F);

}  // namespace render::test
