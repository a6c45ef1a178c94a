#pragma once

#include <string>

#include <fmt/format.h>

namespace frangia {

/// A number with a fixed count of decimals. A number that rounds to zero has no minus sign.
[[nodiscard]] inline std::string fixed_text(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_not_of("-0.") == std::string::npos;
  return zero && text.front() == '-' ? text.substr(1) : text;
}

/// A number with a fixed count of decimals and its sign. Zero has a plus sign.
[[nodiscard]] inline std::string signed_text(double value, int decimals) {
  const std::string text = fixed_text(value, decimals);
  return text.front() == '-' ? text : '+' + text;
}

}  // namespace frangia
