#pragma once

#include <string>

#include <fmt/format.h>

namespace frangia {

/// A share as percent with two decimals, such as "12.34 %". What is not all or nothing does not
/// read as if it were: "under 0.01 %", "over 99.99 %".
/// @shape  `share` from 0 to 1
[[nodiscard]] inline std::string percent_text(double share) {
  if (share > 0.0 && share < 0.0001) return "under 0.01 %";
  if (share < 1.0 && share > 0.9999) return "over 99.99 %";
  return fmt::format("{:.2f} %", 100.0 * share);
}

}  // namespace frangia
