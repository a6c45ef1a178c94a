#pragma once

#include <vector>

namespace frangia::testing {

/// So many numbers as far apart as each other, the first and the last as given.
[[nodiscard]] inline std::vector<double> linspace(int count, double first, double last) {
  std::vector<double> numbers;
  numbers.reserve(static_cast<std::vector<double>::size_type>(count));
  for (int i = 0; i < count; ++i)
    numbers.push_back(first + (last - first) * i / (count - 1));
  return numbers;
}

}  // namespace frangia::testing
