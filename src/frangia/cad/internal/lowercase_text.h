#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace frangia {

/// A text of ASCII letters without capitals.
[[nodiscard]] inline std::string lowercase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return text;
}

}  // namespace frangia
