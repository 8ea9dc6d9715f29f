#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>

#include "render/medium/medium.h"
#include "render/shafts/reference/quadrature.h"
#include "render/shafts/reference/shadow_sheet.h"

namespace render {

// A medium as the reference sees it: `medium`, or, where there is a density, sigma_t(x) = density(x) * that of
// `medium`. A density is finite, not negative and smooth enough for quadrature.
struct ReferenceMedium {
  Medium medium;
  std::function<double(const glm::dvec3& point_in_world)> density{};

  double extinction(const glm::dvec3& point_in_world) const;
  // Integral of sigma_t over the part of the way that lies inside the extent. Throws as optical_depth() does.
  double depth(const glm::dvec3& from_in_world, const glm::dvec3& direction_in_world, double length_m) const;
};

// The part of [0, end_m] of a ray that lies inside an extent (all of it where there is none); nullopt: none of it.
struct Segment {
  double from_m = 0.0;
  double to_m = 0.0;
};
std::optional<Segment> inside(const std::optional<Box>& extent, const ViewRay& ray, double end_m);

// Integrals over one view ray's medium. Fractions are those of light that would be scattered towards the eye at albedo
// 1 and phase function 1: integral of sigma_t T(t) tau dt, T from where the ray enters the medium.
class MediumRay {
 public:
  // `entry_m`: where the ray enters the medium.
  MediumRay(const ReferenceMedium& medium, const ViewRay& ray, double entry_m)
      : reference_medium_(medium), ray_(ray), entry_m_(entry_m) {}

  double view_depth(double t_m) const;  // optical depth from the entry to t
  // tau = 1.
  Quadrature fraction(const LitSegment& segment) const;
  // tau of sunlight, which crosses the medium on its own way. In closed form for a homogeneous medium: the way is
  // linear in t between the places at which the light enters through another face.
  Quadrature sunlit_fraction(const LitSegment& segment, const glm::dvec3& sun_direction_in_world) const;
  // Light of 1 cd from a point, with its phase function: integral of sigma_t T tau p / r^2 dt. Integrated over the
  // angle at the light (dt / r^2 = d angle / distance of the ray), so that it is smooth however near the ray passes.
  Quadrature point_fraction(const LitSegment& segment, const glm::dvec3& light_in_world) const;

 private:
  glm::dvec3 at(double t_m) const { return ray_.origin_in_world + t_m * ray_.direction_in_world; }
  Quadrature sunlit_piece(double from_m, double to_m, const glm::dvec3& sun_direction_in_world) const;

  const ReferenceMedium& reference_medium_;
  ViewRay ray_;
  double entry_m_;
};

}  // namespace render
