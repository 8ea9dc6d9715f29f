#pragma once

#include <algorithm>
#include <vector>

namespace app {

// The middle value, the mean of the two middle ones of an even count, 0 of none.
template <typename T>
double median(std::vector<T> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return static_cast<double>(*middle);
  return 0.5 * (static_cast<double>(*middle) + static_cast<double>(*std::max_element(values.begin(), middle)));
}

}  // namespace app
