#pragma once

#include <cstdint>
#include <vector>

namespace app {

// Percentiles of any number of times in bounded memory: counts in bins of 0.1 ms up to 10 s.
class Distribution {
 public:
  Distribution();

  // Negative counts as 0, more than 10 s as 10 s (the largest stays exact).
  void add(double ms);

  std::int64_t count() const { return count_; }
  // Smallest time that at least that part of all do not exceed, to 0.1 ms; `part` in [0, 1]. 0 of none.
  double percentile_ms(double part) const;
  double largest_ms() const { return largest_ms_; }
  double mean_ms() const { return count_ > 0 ? sum_ms_ / static_cast<double>(count_) : 0.0; }

 private:
  std::vector<std::uint32_t> bins_;
  std::int64_t count_ = 0;
  double sum_ms_ = 0.0;
  double largest_ms_ = 0.0;
};

}  // namespace app
