#include "render/compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <stdexcept>

namespace render {
namespace {

constexpr double kPi = std::numbers::pi;

// The paper's section 4.1: contrast sensitivity of the achromatic, red-green and blue-yellow channels as sums of
// Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> kSensitivity{
    {{1.0, 0.0047, 0.0, 1e-5}, {1.0, 0.0053, 0.0, 1e-5}, {34.1, 0.04, 13.5, 0.025}}};
constexpr double kWidest = 0.04;         // the largest b: all three are cut at three standard deviations of it
constexpr double kColorPower = 0.7;      // q_c
constexpr double kLowShare = 0.4;        // p_c
constexpr double kLowResult = 0.95;      // p_t
constexpr double kFeatureWidth = 0.082;  // w, degrees
constexpr double kFeaturePower = 0.5;    // q_f

// Linear sRGB to XYZ under D65, and back (IEC 61966-2-1, from its primaries).
const glm::dmat3 kXyzFromRgb =
    glm::transpose(glm::dmat3(10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0,
                              2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0,
                              1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0));
const glm::dmat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const glm::dvec3 kWhite = kXyzFromRgb * glm::dvec3(1.0);

using Color = std::array<Plane, 3>;

double linear(double coded) {
  return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

// Y Cx Cz, a linear opponent space (section 4.1).
glm::dvec3 opponent(const glm::dvec3& xyz) {
  const glm::dvec3 n = xyz / kWhite;
  return {116.0 * n.y - 16.0, 500.0 * (n.x - n.y), 200.0 * (n.y - n.z)};
}
glm::dvec3 xyz_of(const glm::dvec3& opponent) {
  const double y = (opponent.x + 16.0) / 116.0;
  return kWhite * glm::dvec3(y + opponent.y / 500.0, y, y - opponent.z / 200.0);
}

// CIELAB, with the chroma that the Hunt effect leaves at that lightness (section 4.1.3).
glm::dvec3 hunt_lab(const glm::dvec3& linear_rgb) {
  const glm::dvec3 n = (kXyzFromRgb * linear_rgb) / kWhite;
  const auto f = [](double t) {
    constexpr double kDelta = 6.0 / 29.0;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
  };
  const double lightness = 116.0 * f(n.y) - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f(n.x) - f(n.y)), 0.01 * lightness * 200.0 * (f(n.y) - f(n.z))};
}

// HyAB distance [Abasi et al. 2020].
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

Color opponent_planes(const Image& image) {
  Color planes;
  for (Plane& plane : planes) plane = {image.width, image.height, {}};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const glm::dvec3 rgb(linear(image.rgba[i] / 255.0), linear(image.rgba[i + 1] / 255.0),
                         linear(image.rgba[i + 2] / 255.0));
    const glm::dvec3 value = opponent(kXyzFromRgb * rgb);
    for (std::size_t c = 0; c < 3; ++c) planes[c].values.push_back(value[static_cast<int>(c)]);
  }
  return planes;
}

// A channel as the eye blurs it. The sum of two Gaussians is normalised over its square window as a whole.
Plane seen(const Plane& plane, const Sensitivity& s, double pixels_per_degree) {
  const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * kPi * kPi)) * pixels_per_degree));
  const auto gaussian = [&](double b) {
    return kernel(radius, [&](double x) {
      const double degrees = x / pixels_per_degree;
      return std::exp(-kPi * kPi * degrees * degrees / b);
    });
  };
  const auto volume = [](double a, double b, const std::vector<double>& weights) {
    double sum = 0.0;
    for (const double w : weights) sum += w;
    return a * std::sqrt(kPi / b) * sum * sum;
  };
  std::vector<double> first = gaussian(s.b1);
  const double first_volume = volume(s.a1, s.b1, first);
  normalize(first);
  Plane out = filtered(plane, first, first);
  if (s.a2 == 0.0) return out;
  std::vector<double> second = gaussian(s.b2);
  const double second_volume = volume(s.a2, s.b2, second);
  normalize(second);
  const Plane other = filtered(plane, second, second);
  const double share = first_volume / (first_volume + second_volume);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = share * out.values[i] + (1.0 - share) * other.values[i];
  }
  return out;
}

std::vector<glm::dvec3> seen_colors(const Color& planes, double pixels_per_degree) {
  Color blurred;
  for (std::size_t c = 0; c < 3; ++c) blurred[c] = seen(planes[c], kSensitivity[c], pixels_per_degree);
  std::vector<glm::dvec3> lab;
  for (std::size_t i = 0; i < blurred[0].values.size(); ++i) {
    const glm::dvec3 value(blurred[0].values[i], blurred[1].values[i], blurred[2].values[i]);
    lab.push_back(hunt_lab(glm::clamp(kRgbFromXyz * xyz_of(value), glm::dvec3(0.0), glm::dvec3(1.0))));
  }
  return lab;
}

// Large differences are compressed into what the small ones leave over (section 4.1.4).
double spread(double difference) {
  static const double largest = std::pow(hyab(hunt_lab({0.0, 1.0, 0.0}), hunt_lab({0.0, 0.0, 1.0})), kColorPower);
  const double low = kLowShare * largest;
  const double powered = std::pow(difference, kColorPower);
  return powered < low ? powered * kLowResult / low
                       : kLowResult + (powered - low) / (largest - low) * (1.0 - kLowResult);
}

// How strongly edges and points show (section 4.2), from first and second derivatives of Gaussians.
struct Features {
  std::vector<double> edge;
  std::vector<double> point;
};
Features features(const Plane& achromatic, double pixels_per_degree) {
  Plane grey = achromatic;
  for (double& v : grey.values) v = (v + 16.0) / 116.0;
  const double deviation = 0.5 * kFeatureWidth * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3.0 * deviation));
  const auto gauss = [&](double x) { return std::exp(-x * x / (2.0 * deviation * deviation)); };
  std::vector<double> smooth = kernel(radius, gauss);
  std::vector<double> first = kernel(radius, [&](double x) { return -x * gauss(x); });
  std::vector<double> second =
      kernel(radius, [&](double x) { return (x * x / (deviation * deviation) - 1.0) * gauss(x); });
  normalize(smooth);
  normalize_signs(first);
  normalize_signs(second);
  const auto magnitude = [&](const std::vector<double>& derivative) {
    const Plane x = filtered(grey, derivative, smooth);
    const Plane y = filtered(grey, smooth, derivative);
    std::vector<double> out;
    for (std::size_t i = 0; i < x.values.size(); ++i) out.push_back(std::hypot(x.values[i], y.values[i]));
    return out;
  };
  return {magnitude(first), magnitude(second)};
}

}  // namespace

Plane flip(const Image& test, const Image& truth, double pixels_per_degree) {
  if (test.width != truth.width || test.height != truth.height) {
    throw std::invalid_argument("flip: the pictures differ in size");
  }
  const Color test_planes = opponent_planes(test);
  const Color truth_planes = opponent_planes(truth);
  const std::vector<glm::dvec3> test_lab = seen_colors(test_planes, pixels_per_degree);
  const std::vector<glm::dvec3> truth_lab = seen_colors(truth_planes, pixels_per_degree);
  const Features a = features(test_planes[0], pixels_per_degree);
  const Features b = features(truth_planes[0], pixels_per_degree);
  Plane out{test.width, test.height, {}};
  for (std::size_t i = 0; i < test_lab.size(); ++i) {
    const double color = spread(hyab(test_lab[i], truth_lab[i]));
    const double change = std::max(std::abs(a.edge[i] - b.edge[i]), std::abs(a.point[i] - b.point[i]));
    const double feature = std::pow(change / std::numbers::sqrt2, kFeaturePower);
    out.values.push_back(std::pow(color, 1.0 - feature));
  }
  return out;
}

}  // namespace render
