#pragma once

namespace render {

// The five shape parameters of the all-weather sky (Perez, Seals, Michalsky 1993, eq. 1); Preetham 1999 and the CIE
// skies are written with the same letters.
struct PerezShape {
  double a = 0.0;  // brightening (< 0) or darkening (> 0) of the horizon
  double b = 0.0;  // gradient near the horizon, < 0 in a valid sky
  double c = 0.0;  // strength of the circumsolar region
  double d = 0.0;  // its width, < 0
  double e = 0.0;  // light scattered backwards
};

// (1 + a exp(b / cos theta)) (1 + c exp(d gamma) + e cos^2 gamma), Perez 1993 eq. 1. cos_view_zenith is kept at or
// above 1e-3: at the horizon exp(b / cos theta) has long reached its limit 0. gamma_rad in [0, pi].
double perez_luminance(const PerezShape& shape, double cos_view_zenith, double gamma_rad, double cos_gamma);

// Sky clearness, Perez 1990 eq. 1, from direct normal and diffuse horizontal irradiance (W/m2; negative readings count
// as 0) and the sun's zenith angle. Within [1, 12]; 1 where there is no light at all.
double sky_clearness(double dni_wm2, double dhi_wm2, double sun_zenith_rad);

// Sky brightness, Perez 1990 eq. 2, with the relative air mass of Kasten 1966, as they used it. Within [0.01, 0.6].
double sky_brightness(double dhi_wm2, double sun_zenith_rad, double extraterrestrial_normal_wm2);

// The irradiances in W/m2 that have that clearness and brightness: the inverses of the two above. 0 with clearness 1.
double dni_from_clearness(double clearness, double dhi_wm2, double sun_zenith_rad);
double dhi_from_brightness(double brightness, double sun_zenith_rad, double extraterrestrial_normal_wm2);

// Whether the coefficients change in steps at the limits of the eight clearness bins, as published, or are interpolated
// between the bins' centres, so that a changing sky does not jump.
enum class PerezBins { Original, Interpolated };

// Shape for clearness in [1, inf), brightness and the sun's zenith angle, held in [0, pi/2]. Brightness is held within
// [0.01, 0.6] and inside each bin's limits of validity: at least 0.2 in bins 2 to 5, and such that b stays negative in
// bins 6 and 8.
PerezShape perez_shape(double clearness, double brightness, double sun_zenith_rad,
                       PerezBins bins = PerezBins::Interpolated);

// The shape with `a` raised as far as it takes for the gradation to stay positive up to the zenith. Outside their range
// the tables give skies that are negative there, and then everywhere once they are normalised.
PerezShape without_dark_zenith(PerezShape shape);

// The brightness that perez_shape() works with in the bin of `clearness` when it is asked for `brightness`.
double held_brightness(double clearness, double brightness, double sun_zenith_rad);

// Luminous efficacy in lm/W of diffuse and of direct light (Perez 1990, eq. 7 and 8, table 4), by clearness,
// brightness (held in [0.01, 0.6]) and zenith angle, for 2 cm of precipitable water. Its bins jump by up to 4 %:
// interpolated like the shape's.
double diffuse_efficacy(double clearness, double brightness, double sun_zenith_rad, PerezBins bins);
double direct_efficacy(double clearness, double brightness, double sun_zenith_rad, PerezBins bins);

}  // namespace render
