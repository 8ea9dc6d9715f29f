#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <stdexcept>

#include "render/base/angles.h"
#include "render/sky/cie.h"
#include "render/sky/clouds.h"
#include "render/sky/dusk_sky.h"
#include "render/sky/form_sky.h"
#include "render/sky/hemisphere.h"
#include "render/sky/night_sky.h"
#include "render/sky/reference_sky.h"
#include "render/sky/scattering_sky.h"
#include "render/sky/sky_condition.h"
#include "render/sky/sky_image.h"
#include "render/sky/sky_model.h"
#include "render/sky/twilight.h"
#include "render/sun/spectrum.h"

namespace render {
namespace {

constexpr Handover kClearHandover{8.0 * kRadPerDeg, 0.0};   // turbid models lose their colours in the last degrees
constexpr Handover kGivenHandover{0.0, -4.0 * kRadPerDeg};  // what was asked for holds as long as the sun is up

class BlackSky final : public SkyModel {
 public:
  glm::dvec3 luminance_rgb(const glm::dvec3&) const override { return glm::dvec3(0.0); }
};

std::unique_ptr<SkyModel> perez(const SkyOptions& options, const SunPosition& sun) {
  const Day day = day_of(sun);
  const bool given = options.condition || options.irradiance;
  const Condition condition = condition_of(options, day);
  SkyForm form;
  form.shape =
      without_dark_zenith(perez_shape(condition.clearness, condition.brightness, day.zenith_rad, options.bins));
  form.colors = make_reference_colors(options.turbidity, day.sun);
  form.whiteness = std::clamp((1.5 - condition.clearness) / 0.5, 0.0, 1.0);  // clearness 1 is a grey sky
  const double level = given ? condition.diffuse_lux * twilight_dimming(sun.elevation_rad)
                             : diffuse_level_lux(condition.diffuse_lux, sun, options.turbidity);
  return make_dusk_sky(make_form_sky(form, day.sun, condition.diffuse_lux), sun, options.turbidity, level,
                       given ? kGivenHandover : kClearHandover, 1.0 - form.whiteness);
}

std::unique_ptr<SkyModel> preetham(const SkyOptions& options, const SunPosition& sun, bool rescaled) {
  const Day day = day_of(sun);
  SkyOptions clear = options;
  if (rescaled) clear.turbidity = std::max(options.turbidity, 2.0);
  const double turbidity = clear.turbidity;
  const SkyForm form{preetham_shapes(turbidity).luminance, Indicatrix::Perez, turbidity, nullptr, 0.0};
  const double zenith_cdm2 = std::max(preetham_zenith(turbidity, day.zenith_rad).luminance_kcdm2, 0.0) * 1e3;
  auto published = make_form_sky_at_zenith(form, day.sun, zenith_cdm2);
  if (rescaled) {
    const double level = diffuse_level_lux(clear_condition(clear, day).diffuse_lux, sun, turbidity);
    return make_dusk_sky(std::move(published), sun, turbidity, level, kClearHandover, 1.0);
  }
  const double level = luminance(horizontal_illuminance(*published)) * twilight_dimming(sun.elevation_rad);
  return make_dusk_sky(std::move(published), sun, turbidity, level, kGivenHandover, 1.0);
}

// The standard leaves level and colour open: between Krochmann's overcast (300 + 21000 sin) and the clear-sky model.
std::unique_ptr<SkyModel> cie(int type, const SkyOptions& options, const SunPosition& sun) {
  const Day day = day_of(sun);
  const double clearness = cie_clearness(type);
  const double overcast_lux = 300.0 + 21000.0 * std::sin(day.sun.elevation_rad);
  const double clear_lux = std::max(clear_condition(options, day).diffuse_lux, 1.0);
  const double lux = std::exp(glm::mix(std::log(overcast_lux), std::log(clear_lux), clearness));
  SkyForm form{cie_shape(type), Indicatrix::Cie, options.turbidity, nullptr, 1.0 - clearness};
  if (clearness > 0.0) form.colors = make_reference_colors(options.turbidity, day.sun);
  return make_dusk_sky(make_form_sky(form, day.sun, lux), sun, options.turbidity,
                       lux * twilight_dimming(sun.elevation_rad), kGivenHandover, clearness);
}

std::unique_ptr<SkyModel> scattering(const SkyOptions& options, const SunPosition& sun) {
  const Day day = day_of(sun);
  const double level = diffuse_level_lux(clear_condition(options, day).diffuse_lux, sun, options.turbidity);
  return make_dusk_sky(make_scattering_sky(options.turbidity, day.sun), sun, options.turbidity, level, kClearHandover,
                       1.0);
}

int cie_type(const std::string& text) {
  try {
    std::size_t used = 0;
    const int type = std::stoi(text, &used);
    if (used == text.size() && type >= 1 && type <= 15) return type;
  } catch (const std::logic_error&) {
    // not a number: the same message
  }
  throw std::runtime_error("unknown sky model `cie:" + text + "`\nthe CIE skies are cie:1 to cie:15");
}

std::unique_ptr<SkyModel> cloudless(const SkyOptions& options, const SunPosition& sun) {
  const std::string& model = options.model;
  if (model == "perez") return perez(options, sun);
  if (model == "preetham") return preetham(options, sun, false);
  if (model == "preetham:rescaled") return preetham(options, sun, true);
  if (model == "scattering") return scattering(options, sun);
  if (model == "reference") return make_reference_sky(options.turbidity, sun);
  if (model.starts_with("cie:")) return cie(cie_type(model.substr(4)), options, sun);
  if (model.starts_with("image:")) {
    const double diffuse_lux =
        diffuse_level_lux(clear_condition(options, day_of(sun)).diffuse_lux, sun, options.turbidity);
    return make_image_sky(model.substr(6), sun, diffuse_lux);
  }
  throw std::runtime_error("unknown sky model `" + model +
                           "`\nknown models: perez, preetham, preetham:rescaled, cie:1 to cie:15, scattering, "
                           "reference, image:FILE, none");
}

std::unique_ptr<SkyModel> with_night(std::unique_ptr<SkyModel> sky, const SkyOptions& options, const SunPosition& sun) {
  if (sun.elevation_rad >= 0.0) return sky;
  const double moon_share = options.moon ? moon_to_sun(*options.moon) : 0.0;
  std::unique_ptr<SkyModel> moonlit;
  if (moon_share > 0.0) moonlit = perez({.turbidity = options.turbidity}, as_sun(*options.moon));
  return make_night_sky(std::move(sky), std::move(moonlit), moon_share);
}

// Clouds still see the sun when the ground no longer does.
CloudLight sun_on_clouds(const SunPosition& sun, double turbidity, double height_m) {
  const double dip_rad = std::sqrt(2.0 * height_m / 6371000.0);
  SunPosition seen = sun;
  seen.apparent_elevation_rad += dip_rad;
  return {sun.apparent_direction_in_world(), sun_light(seen, turbidity, height_m).illuminance_rgb};
}

std::unique_ptr<SkyModel> with_clouds(std::unique_ptr<SkyModel> sky, const SkyOptions& options,
                                      const SunPosition& sun) {
  std::vector<CloudLayer> layers = cloud_preset(options.clouds.preset);
  if (layers.empty()) return sky;
  std::vector<CloudLight> lights{sun_on_clouds(sun, options.turbidity, layers.front().height_m)};
  if (options.moon && sun.elevation_rad < 0.0) {
    lights.push_back(
        {options.moon->apparent_direction_in_world(), moon_illuminance_rgb(*options.moon, options.turbidity)});
  }
  return make_cloudy_sky(std::move(sky), std::move(layers), std::move(lights), options.clouds.time_s,
                         options.clouds.seed);
}

}  // namespace

glm::dvec3 SkyModel::luminance_xyz(const glm::dvec3& direction_in_world) const {
  return xyz_from_rgb(luminance_rgb(direction_in_world));
}

std::unique_ptr<SkyModel> make_sky(const SkyOptions& options, const SunPosition& sun) {
  if (options.model == "none") return std::make_unique<BlackSky>();
  return with_clouds(with_night(cloudless(options, sun), options, sun), options, sun);
}

}  // namespace render
