#include "render/shafts/reference/quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

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
// A smooth integrand takes a handful; one that falls off within a millionth of the interval some forty.
constexpr std::size_t kMostPieces = 1000;

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

Quadrature operator+(const Quadrature& a, const Quadrature& b) {
  return {a.value + b.value, a.error + b.error};
}

// A piece of the interval that is not yet divided.
struct Piece {
  double from = 0.0;
  double to = 0.0;
  Quadrature integral;

  bool operator<(const Piece& other) const { return integral.error < other.integral.error; }
};

// Whether halving it could still gain anything.
bool is_exhausted(const Piece& piece) {
  const double middle = 0.5 * (piece.from + piece.to);
  return piece.integral.error <= 1e-15 * std::abs(piece.integral.value) || middle <= piece.from || middle >= piece.to;
}

// Pieces that halve towards both ends: what falls off so steeply that no node of the whole meets it begins at one.
std::vector<Piece> graded_pieces(const Function& function, double from, double to) {
  constexpr int kHalvings = 40;
  std::vector<double> bounds{from, to, 0.5 * (from + to)};
  for (int k = 2; k <= kHalvings; ++k) {
    bounds.push_back(from + std::ldexp(to - from, -k));
    bounds.push_back(to - std::ldexp(to - from, -k));
  }
  std::ranges::sort(bounds);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    if (bounds[i] < bounds[i + 1]) {
      pieces.push_back({bounds[i], bounds[i + 1], rule(function, bounds[i], bounds[i + 1])});
    }
  }
  return pieces;
}

// Summed anew each time: differences of sums would leave rounding behind.
Quadrature total(const std::vector<Piece>& pieces, const Quadrature& done) {
  Quadrature sum = done;
  for (const Piece& piece : pieces) sum = sum + piece.integral;
  return sum;
}

}  // namespace

Quadrature integrate(const std::function<double(double)>& function, double from, double to, double relative,
                     double absolute) {
  if (from >= to) return {};
  std::vector<Piece> pieces{{from, to, rule(function, from, to)}};
  if (pieces.front().integral.value == 0.0) pieces = graded_pieces(function, from, to);
  std::make_heap(pieces.begin(), pieces.end());
  Quadrature sum = total(pieces, {});
  Quadrature done;  // of pieces that are as good as double precision makes them
  while (!pieces.empty() && sum.error > std::fmax(absolute, relative * std::abs(sum.value))) {
    std::pop_heap(pieces.begin(), pieces.end());
    const Piece worst = pieces.back();
    pieces.pop_back();
    if (is_exhausted(worst)) {
      done = done + worst.integral;
      continue;
    }
    if (pieces.size() >= kMostPieces) {
      pieces.push_back(worst);
      break;
    }
    const double middle = 0.5 * (worst.from + worst.to);
    for (const Piece& half : {Piece{worst.from, middle, rule(function, worst.from, middle)},
                              Piece{middle, worst.to, rule(function, middle, worst.to)}}) {
      pieces.push_back(half);
      std::push_heap(pieces.begin(), pieces.end());
    }
    sum = total(pieces, done);
  }
  return sum;
}

}  // namespace render
