#pragma once

#include <vector>

namespace frangia::testing {

/// Evenly spaced numbers between two given ends, which are included.
[[nodiscard]] inline std::vector<double> linspace(int count, double first, double last) {
  std::vector<double> numbers;
  numbers.reserve(static_cast<std::vector<double>::size_type>(count));
  for (int i = 0; i < count; ++i)
    numbers.push_back(first + (last - first) * i / (count - 1));
  return numbers;
}

}  // namespace frangia::testing
