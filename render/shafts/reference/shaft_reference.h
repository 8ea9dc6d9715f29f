#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "render/scene/scene_state.h"
#include "render/scene/view.h"
#include "render/shafts/reference/medium_ray.h"
#include "render/shafts/reference/occluder_tree.h"

namespace render {

// A point that sends the same light everywhere.
struct PointLight {
  glm::dvec3 position_in_world{0.0};
  glm::dvec3 luminous_intensity_rgb{0.0};  // cd
};

// None; as SkyLight says, everywhere the whole sky (what the techniques that trace no sky take); or by patches that
// occluders hide.
enum class ReferenceSky { None, Open, Traced };

struct ReferenceSettings {
  ReferenceSky sky = ReferenceSky::Traced;
  // Relative error at which the sun's disc has been sampled enough; the sky's patches are chosen for the same.
  double max_error = 1e-3;
  int max_disc_samples = 512;
  std::function<double(const glm::dvec3& point_in_world)> density{};  // ReferenceMedium
  std::vector<PointLight> lights{};
};

// What a view ray brings to the eye.
struct ReferenceLight {
  glm::dvec3 luminance_rgb{0.0};  // scattered by the medium, cd/m2, not exposed
  double transmittance = 1.0;
  glm::dvec3 error_rgb{0.0};  // estimated, cd/m2
};

// A shaft picture on the CPU, row 0 at the top.
struct ReferencePicture {
  int width = 0;
  int height = 0;
  std::vector<glm::vec4> rgba;  // in-scattered luminance_rgb in cd/m2, not exposed; transmittance
  double mean_error = 0.0;      // estimated, relative to the mean luminance
  double largest_error = 0.0;   // of any pixel and channel, relative to the largest luminance
};

// Light scattered towards the eye as docs/shafts.md defines it, in double precision: the truth that the techniques
// are measured against. Sun (a direction, or a disc as the mean of many), sky, point lights. Shadow boundaries are
// exact (ShadowSheet); between them integrals are closed forms, or quadrature to 1e-10. What is left is the sampling of
// the sun's disc and of the sky, which is estimated and reported. All calls are const and may run on many threads.
class ShaftReference {
 public:
  // scene.medium is present. Throws std::runtime_error when Embree fails.
  explicit ShaftReference(const SceneState& scene, const ReferenceSettings& settings = {});

  // Along a unit direction, up to `end_m` (may be infinite).
  ReferenceLight along(const ViewRay& ray, double end_m) const;

  // One ray through each pixel's centre, on all cores. `axis_distance_m`: what ends each ray, along the camera's axis,
  // 1e9 and more: nothing; empty: nothing anywhere. It is put exactly onto the triangle that it is meant to be on.
  // `progress` is told how many rows are done, from one thread at a time.
  ReferencePicture picture(const View& view, std::span<const float> axis_distance_m,
                           const std::function<void(int rows)>& progress = {}) const;

 private:
  struct Tally;
  struct SkySample {
    glm::dvec3 direction_in_world;
    glm::dvec3 illuminance_rgb;  // luminance times solid angle
  };

  void sun_light(const ViewRay& ray, const MediumRay& path, const Segment& segment, ReferenceLight& out) const;
  glm::dvec3 sun_from(const glm::dvec3& direction, const ViewRay& ray, const MediumRay& path, const Segment& segment,
                      glm::dvec3& error) const;
  void sky_light(const ViewRay& ray, const MediumRay& path, const Segment& segment, ReferenceLight& out) const;
  glm::dvec3 traced_sky(const std::vector<SkySample>& sky, const ViewRay& ray, const MediumRay& path,
                        const Segment& segment) const;
  void point_light(const PointLight& light, const ViewRay& ray, const MediumRay& path, const Segment& segment,
                   ReferenceLight& out) const;
  double end_on_surface(const ViewRay& ray, double axis_distance_m, double metres_per_z) const;
  Tally row(const View& view, int y, std::span<const float> axis_distance_m, ReferencePicture& out) const;
  std::vector<SkySample> sky_samples(double max_error) const;

  SceneState scene_;
  ReferenceSettings settings_;
  ReferenceMedium reference_medium_;
  OccluderTree occluders_;
  std::vector<SkySample> sky_;
  std::vector<SkySample> coarse_sky_;
};

}  // namespace render
