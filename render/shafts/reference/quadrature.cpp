#include "render/shafts/reference/quadrature.h"

#include <array>
#include <cmath>

namespace render {
namespace {

constexpr std::array<double, 8> kNodes{0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                       0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                       0.586087235467691130294144838258730, 0.405845151377397166906606412076961,
                                       0.207784955007898467600689403773245, 0.0};
constexpr std::array<double, 8> kKronrod{0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                         0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                         0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                         0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr std::array<double, 4> kGauss{0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                       0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
constexpr int kMostHalvings = 40;

using Function = std::function<double(double)>;

Quadrature rule(const Function& function, double from, double to) {
  const double middle = 0.5 * (from + to);
  const double half = 0.5 * (to - from);
  const double at_middle = function(middle);
  double kronrod = kKronrod[7] * at_middle;
  double gauss = kGauss[3] * at_middle;
  for (std::size_t i = 0; i < 7; ++i) {
    const double pair = function(middle - half * kNodes[i]) + function(middle + half * kNodes[i]);
    kronrod += kKronrod[i] * pair;
    if (i % 2 == 1) gauss += kGauss[i / 2] * pair;
  }
  return {half * kronrod, std::abs(half * (kronrod - gauss))};
}

Quadrature refine(const Function& function, double from, double to, const Quadrature& whole, double tolerance,
                  int depth) {
  const double rounding = 1e-15 * std::abs(whole.value);
  if (whole.error <= std::fmax(tolerance, rounding) || depth == kMostHalvings) return whole;
  const double middle = 0.5 * (from + to);
  const Quadrature left = refine(function, from, middle, rule(function, from, middle), 0.5 * tolerance, depth + 1);
  const Quadrature right = refine(function, middle, to, rule(function, middle, to), 0.5 * tolerance, depth + 1);
  return {left.value + right.value, left.error + right.error};
}

}  // namespace

Quadrature integrate(const std::function<double(double)>& function, double from, double to, double relative,
                     double absolute) {
  if (from >= to) return {};
  const Quadrature whole = rule(function, from, to);
  return refine(function, from, to, whole, std::fmax(absolute, relative * std::abs(whole.value)), 0);
}

}  // namespace render
