#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace frangia {

/// "1 view", "2 views": a count and its noun, whose plural ends in s.
template <typename Count>
[[nodiscard]] std::string counted(Count count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace frangia
