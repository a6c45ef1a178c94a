#pragma once

#include <string>

namespace frangia {

/// A word as a POSIX shell reads it back: in single quotes where it holds anything special.
[[nodiscard]] inline std::string shell_quoted(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string out = "'";
  for (const char letter : word)
    out += letter == '\'' ? std::string(R"('\'')") : std::string(1, letter);
  return out + "'";
}

}  // namespace frangia
