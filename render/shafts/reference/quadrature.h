#pragma once

#include <functional>
#include <glm/vec3.hpp>

namespace render {

struct Quadrature {
  double value = 0.0;
  double error = 0.0;  // estimated, absolute
};

// Integral of a smooth function over [from, to] by Gauss-Kronrod 7-15 (Kronrod 1965; nodes as in QUADPACK's qk15),
// halving the piece with the largest error (QUADPACK's qag) until the sum is as accurate as `relative` of itself or
// `absolute`. Split at jumps before: the rule converges fast only where the function is smooth. Always ends: at machine
// precision, or after a thousand pieces; the error says how good it is then.
Quadrature integrate(const std::function<double(double)>& function, double from, double to, double relative = 1e-9,
                     double absolute = 0.0);

}  // namespace render
