#include "app/synth/light.h"

#include <algorithm>
#include <numbers>

#include "render/base/luminance.h"

namespace app::synth {

namespace {

// Cosine lobe times spherical harmonics, as one polynomial in the normal (Ramamoorthi & Hanrahan 2001, eq. 12).
std::array<glm::vec3, 9> irradiance_polynomial(const render::Sh9& sh) {
  constexpr double kPi = std::numbers::pi;
  const std::array<double, 9> factor{
      kPi * 0.282095,       2.0 * kPi / 3.0 * 0.488603, 2.0 * kPi / 3.0 * 0.488603, 2.0 * kPi / 3.0 * 0.488603,
      kPi / 4.0 * 1.092548, kPi / 4.0 * 1.092548,       kPi / 4.0 * 0.315392,       kPi / 4.0 * 1.092548,
      kPi / 4.0 * 0.546274};
  std::array<glm::vec3, 9> polynomial;
  for (std::size_t i = 0; i < 9; ++i) polynomial[i] = glm::vec3(sh[i] * factor[i]);
  return polynomial;
}

double luminance(const glm::dvec3& rgb) {
  return render::rec709_luminance<double>(rgb.r, rgb.g, rgb.b);
}

}  // namespace

Light::Light(const Spec& spec) {
  const render::Place place{spec.latitude_deg * std::numbers::pi / 180.0, spec.longitude_deg * std::numbers::pi / 180.0,
                            spec.height_m};
  const auto middle = std::chrono::microseconds(static_cast<std::int64_t>(spec.time_of_frame_s(spec.frames) * 0.5e6));
  sun_ = render::sun_position(place, spec.time + middle);
  const glm::dvec3 direction = sun_.apparent_direction_in_world();
  const glm::dvec3 beam = render::sun_light(sun_, spec.turbidity, spec.height_m).illuminance_rgb;
  sky_ = render::make_sky({.model = spec.sky_model, .turbidity = spec.turbidity}, sun_);
  const glm::dvec3 on_ground = beam * std::max(direction.z, 0.0);
  const render::SkyLight sky_light = render::sky_light(*sky_, on_ground);
  irradiance_ = irradiance_polynomial(sky_light.radiance_sh);
  sun_direction_ = glm::vec3(direction);
  sun_illuminance_ = glm::vec3(beam);
  sun_radius_rad_ = static_cast<float>(sun_.angular_radius_rad);
  const double lux = luminance(on_ground + sky_light.horizontal_illuminance_rgb);
  exposure_ = spec.exposure.value_or(std::numbers::pi / std::max(lux, 1e-3));
}

glm::vec3 Light::sky_illuminance(const glm::vec3& n) const {
  const auto& c = irradiance_;
  const glm::vec3 e = c[0] + c[1] * n.y + c[2] * n.z + c[3] * n.x + c[4] * (n.x * n.y) + c[5] * (n.y * n.z) +
                      c[6] * (3.0F * n.z * n.z - 1.0F) + c[7] * (n.x * n.z) + c[8] * (n.x * n.x - n.y * n.y);
  return glm::max(e, glm::vec3(0.0F));
}

glm::vec3 Light::sky_luminance(const glm::vec3& direction) const {
  return glm::vec3(sky_->luminance_rgb(glm::dvec3(direction)));
}

}  // namespace app::synth
