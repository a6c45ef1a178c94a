#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "frangia/core/enum_names.h"

namespace frangia {

// Checks of option values, with one clear message each. CLI11's own checks accept "nan" as a
// positive number and print the largest double in full.

/// A finite number.
[[nodiscard]] CLI::Validator a_number();

/// A finite number above 0, or one of `words`.
[[nodiscard]] CLI::Validator above_zero(const std::vector<std::string>& words = {});

/// A finite number of 0 or more.
[[nodiscard]] CLI::Validator zero_or_more();

/// A finite number from `least` to `most`.
[[nodiscard]] CLI::Validator from_to(double least, double most);

/// A whole number from `least` to `most`, also as "2e5". For CLI::Option::transform: the option's
/// variable receives its digits.
[[nodiscard]] CLI::Validator whole_from_to(std::size_t least, std::size_t most);

/// One of `words`.
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

// Lengths: "1mm", "0.5in", or a number in mm, as parse_length_mm reads them. For
// CLI::Option::transform: the option's variable receives mm.

[[nodiscard]] CLI::Validator a_length();
[[nodiscard]] CLI::Validator length_above_zero();
[[nodiscard]] CLI::Validator length_zero_or_more();

/// A unit of length: um, mm, cm, m, in, ft, or a length such as "25.4mm". For
/// CLI::Option::transform: the option's variable receives mm.
[[nodiscard]] CLI::Validator unit_length();

/// A size of memory: "2GB", "500 MB", or a number of bytes. For CLI::Option::transform: the
/// option's variable receives bytes.
[[nodiscard]] CLI::Validator size_above_zero();

/// The name of an enum's value, see names_of; for CLI::Option::transform.
template <NamedEnum Enum>
[[nodiscard]] CLI::Validator named() {
  return {[known = one_of(all_names<Enum>())](std::string& input) {
            std::string wrong = known(input);
            if (wrong.empty())
              input = fmt::format("{}", static_cast<int>(*find_named<Enum>(input)));
            return wrong;
          },
          ""};
}

}  // namespace frangia
