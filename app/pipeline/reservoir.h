#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "render/base/median.h"

namespace app {

// A fair sample of any number of values in bounded memory: each value is in it with the same probability. Vitter,
// "Random Sampling with a Reservoir" (1985), algorithm R.
class Reservoir {
 public:
  static constexpr std::size_t kKept = 1024;  // the median is then good to 1.6 % of the values' ranks

  void add(double value) {
    ++seen_;
    if (kept_.size() < kKept) {
      kept_.push_back(value);
      return;
    }
    const auto place = std::uniform_int_distribution<std::uint64_t>(0, seen_ - 1)(random_);
    if (place < kKept) kept_[place] = value;
  }

  // Of the sample; exact up to kKept values. 0 of none.
  double median() const { return render::median(kept_, 0.0); }

 private:
  std::vector<double> kept_;
  std::uint64_t seen_ = 0;
  std::minstd_rand random_;  // begins the same each time
};

}  // namespace app
