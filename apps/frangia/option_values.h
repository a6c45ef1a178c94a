#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace frangia {

// What the value of an option may be; each says in plain words what it is when it is not. CLI11's
// own take "nan" for a positive number and answer with the largest double in full.

/// A finite number.
[[nodiscard]] CLI::Validator a_number();

/// A finite number above 0, or one of some words.
[[nodiscard]] CLI::Validator above_zero(const std::vector<std::string>& words = {});

/// A finite number of 0 or more.
[[nodiscard]] CLI::Validator zero_or_more();

/// A finite number within two.
[[nodiscard]] CLI::Validator from_to(double least, double most);

/// One of some words.
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

/// One of the names of an enum's values; for CLI::Option::transform.
template <typename Enum>
[[nodiscard]] CLI::Validator named(const std::map<std::string, Enum>& values) {
  std::vector<std::string> names;
  names.reserve(values.size());
  for (const auto& [name, value] : values)
    names.push_back(name);
  return {[values, known = one_of(names)](std::string& input) {
            std::string wrong = known(input);
            if (wrong.empty()) input = fmt::format("{}", static_cast<int>(values.at(input)));
            return wrong;
          },
          ""};
}

}  // namespace frangia
