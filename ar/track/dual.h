#pragma once

#include <cmath>

namespace ar {

// A number with its derivatives by two variables (forward-mode differentiation), so that each lens formula is written
// once and its Jacobian cannot disagree with it.
struct Dual2 {
  double value = 0.0;
  double dx = 0.0;
  double dy = 0.0;

  Dual2() = default;
  Dual2(double v) : value(v) {}  // NOLINT(google-explicit-constructor): constants mix with duals in formulas
  Dual2(double v, double by_x, double by_y) : value(v), dx(by_x), dy(by_y) {}
};

inline Dual2 operator+(const Dual2& a, const Dual2& b) {
  return {a.value + b.value, a.dx + b.dx, a.dy + b.dy};
}
inline Dual2 operator-(const Dual2& a, const Dual2& b) {
  return {a.value - b.value, a.dx - b.dx, a.dy - b.dy};
}
inline Dual2 operator*(const Dual2& a, const Dual2& b) {
  return {a.value * b.value, a.dx * b.value + a.value * b.dx, a.dy * b.value + a.value * b.dy};
}
inline Dual2 operator/(const Dual2& a, const Dual2& b) {
  const double q = a.value / b.value;
  return {q, (a.dx - q * b.dx) / b.value, (a.dy - q * b.dy) / b.value};
}
inline Dual2 sqrt(const Dual2& a) {
  const double s = std::sqrt(a.value);
  return {s, 0.5 * a.dx / s, 0.5 * a.dy / s};
}
inline Dual2 atan(const Dual2& a) {
  const double d = 1.0 / (1.0 + a.value * a.value);
  return {std::atan(a.value), a.dx * d, a.dy * d};
}
inline double value_of(double a) {
  return a;
}
inline double value_of(const Dual2& a) {
  return a.value;
}

}  // namespace ar
