#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace frangia {

/// The median of the absolute values of normal deviates, over their standard deviation.
inline constexpr double kMedianOfNormal = 0.6745;

/// Returns the median of `values` and reorders them. For an even count it is the upper one of the
/// two middle values: always a value that occurs, never a mean of two. Of no values it is 0.
///
/// @missing  not allowed: remove NaN values first
template <typename T>
[[nodiscard]] T median_in_place(std::span<T> values) {
  if (values.empty()) return T{};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns the median of `values` as `median_in_place` defines it; the caller's values keep their
/// order.
template <typename T>
[[nodiscard]] T median(std::vector<T> values) {
  return median_in_place(std::span<T>(values));
}

}  // namespace frangia
