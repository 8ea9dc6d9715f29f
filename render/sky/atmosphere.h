#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "render/sky/bands.h"

namespace render {

// A clear, spherically layered atmosphere: molecules, aerosol and ozone. What depends on the air alone is tabulated
// when it is made (about 50 ms); after that it is constant and may be shared between threads.
class Atmosphere {
 public:
  static constexpr double kGroundRadiusM = 6371000.0;
  static constexpr double kTopRadiusM = kGroundRadiusM + 100000.0;

  // Optical depth of the aerosol straight up at 1 um for a Linke turbidity. Linke's counts water vapour too: 1.74
  // stands for air without aerosol. The slope is Preetham's (1999, A.1); together they give the diffuse light of
  // clear_sky_irradiance() at the same turbidity.
  static double aerosol_depth_at_1um(double turbidity);

  // Linke turbidity in [1, 20]; it sets the aerosol by Angstrom's formula. The ground returns `ground_albedo` of the
  // light that reaches it; grass and woods return 0.08 of visible light.
  explicit Atmosphere(double turbidity, double ground_albedo = 0.08);

  // One atmosphere for each turbidity asked for (the last few are kept).
  static std::shared_ptr<const Atmosphere> shared(double turbidity);

  // Extinction of a path: lengths in metres that the path would have in the densest air of each kind.
  struct Columns {
    double molecules_m = 0.0;
    double aerosol_m = 0.0;
    double ozone_m = 0.0;
  };
  // Scattering (1/m) and extinction (1/m) at a point.
  struct Point {
    Bands molecular_scattering;
    Bands aerosol_scattering;
    Bands extinction;
  };

  Columns densities(double radius_m) const;  // relative, 1 where densest
  Point point(double radius_m) const;
  Bands transmittance(const Columns& columns) const;

  // Share of the sun's light outside the atmosphere that arrives at a point whose local sun zenith cosine is mu;
  // fades to 0 as the solid Earth covers the disc.
  Bands sunlight(double radius_m, double mu) const;

  // Isotropic part of the light that was scattered more than once, per unit of solar irradiance, 1/sr (Hillaire 2020,
  // eq. 5-10, with the true phase functions in the first scattering).
  Bands multiple_scattering(double radius_m, double mu) const;

  // Phase functions, 1/sr.
  double molecular_phase(double cos_theta) const;
  double aerosol_phase(double cos_theta) const;

  // Length of a ray from a point at radius_m with local zenith cosine mu to the ground or to the top.
  struct Reach {
    double length_m;
    bool hits_ground;
  };
  static Reach reach(double radius_m, double mu);

 private:
  Columns integrate_columns(double radius_m, double mu) const;
  Columns columns_to_top(double radius_m, double mu) const;
  void tabulate_columns();
  void tabulate_multiple_scattering();
  Bands scatter_twice(double radius_m, double mu) const;

  Bands molecular_scattering_{};
  Bands aerosol_scattering_{};
  Bands aerosol_extinction_{};
  Bands ozone_absorption_{};
  double ground_albedo_;
  std::vector<Columns> columns_;
  std::vector<Bands> multiple_;
};

}  // namespace render
