#include "app/live/distribution.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr double kBinMs = 0.1;
constexpr std::size_t kBins = 100'000;

}  // namespace

Distribution::Distribution() : bins_(kBins, 0) {}

void Distribution::add(double ms) {
  const double kept = std::max(ms, 0.0);
  const auto bin = static_cast<std::size_t>(kept / kBinMs);
  ++bins_[std::min(bin, kBins - 1)];
  ++count_;
  sum_ms_ += kept;
  largest_ms_ = std::max(largest_ms_, kept);
}

double Distribution::percentile_ms(double part) const {
  const auto wanted = std::max<std::int64_t>(1, std::llround(std::ceil(part * static_cast<double>(count_))));
  std::int64_t seen = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    seen += bins_[bin];
    if (seen >= wanted) return std::min(kBinMs * static_cast<double>(bin + 1), largest_ms_);
  }
  return 0.0;
}

}  // namespace app
