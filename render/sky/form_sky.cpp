#include "render/sky/form_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <numbers>

#include "render/sky/cie.h"
#include "render/sky/direction.h"
#include "render/sky/hemisphere.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr double kWhiteX = 0.3127;  // D65
constexpr double kWhiteY = 0.3290;

class FormSky final : public SkyModel {
 public:
  FormSky(const SkyForm& form, const SunPosition& sun)
      : form_(form), sun_in_world_(daytime_sun_direction(sun)), colors_(preetham_shapes(form.color_turbidity)) {
    const double zenith = std::acos(std::clamp(sun_in_world_.z, 0.0, 1.0));
    color_ = preetham_zenith(form.color_turbidity, zenith);
    color_.x /= perez_luminance(colors_.x, 1.0, zenith, sun_in_world_.z);
    color_.y /= perez_luminance(colors_.y, 1.0, zenith, sun_in_world_.z);
  }

  void scale_to_diffuse(double diffuse_lux) {
    double sum = 0.0;
    for (const SolidAngleSample& sample : upper_hemisphere()) {
      const glm::dvec3& view = sample.direction_in_world;
      sum += relative(view, angle_between(view, sun_in_world_)) * view.z * sample.solid_angle_sr;
    }
    scale_ = sum > 0.0 ? diffuse_lux / sum : 0.0;
  }

  void scale_to_zenith(double zenith_cdm2) {
    const glm::dvec3 up(0.0, 0.0, 1.0);
    const double value = relative(up, angle_between(up, sun_in_world_));
    scale_ = value > 0.0 ? zenith_cdm2 / value : 0.0;
  }

  glm::dvec3 luminance_rgb(const glm::dvec3& direction_in_world) const override {
    return clip_to_gamut(rgb_from_xyz(luminance_xyz(direction_in_world)));
  }

  glm::dvec3 luminance_xyz(const glm::dvec3& direction_in_world) const override {
    const glm::dvec3 view = above_horizon(direction_in_world);
    const Angle gamma = angle_between(view, sun_in_world_);
    const double level = scale_ * relative(view, gamma);
    const glm::dvec2 xy = chromaticity(view, gamma);
    return xyz_from_yxy(level, glm::mix(xy.x, kWhiteX, form_.whiteness), glm::mix(xy.y, kWhiteY, form_.whiteness));
  }

 private:
  glm::dvec2 chromaticity(const glm::dvec3& view, const Angle& gamma) const {
    if (form_.colors) {
      const glm::dvec3 xyz = form_.colors->luminance_xyz(view);
      const double sum = xyz.x + xyz.y + xyz.z;
      return sum > 0.0 ? glm::dvec2(xyz.x / sum, xyz.y / sum) : glm::dvec2(kWhiteX, kWhiteY);
    }
    return {color_.x * perez_luminance(colors_.x, view.z, gamma.radians, gamma.cosine),
            color_.y * perez_luminance(colors_.y, view.z, gamma.radians, gamma.cosine)};
  }

  double relative(const glm::dvec3& view, const Angle& gamma) const {
    const auto formula = form_.indicatrix == Indicatrix::Cie ? cie_luminance : perez_luminance;
    return std::max(formula(form_.shape, view.z, gamma.radians, gamma.cosine), 0.0);
  }

  SkyForm form_;
  glm::dvec3 sun_in_world_;
  PreethamShapes colors_;
  PreethamZenith color_;
  double scale_ = 0.0;
};

}  // namespace

std::unique_ptr<SkyModel> make_form_sky(const SkyForm& form, const SunPosition& sun, double diffuse_lux) {
  auto sky = std::make_unique<FormSky>(form, sun);
  sky->scale_to_diffuse(diffuse_lux);
  return sky;
}

std::unique_ptr<SkyModel> make_form_sky_at_zenith(const SkyForm& form, const SunPosition& sun, double zenith_cdm2) {
  auto sky = std::make_unique<FormSky>(form, sun);
  sky->scale_to_zenith(zenith_cdm2);
  return sky;
}

}  // namespace render
