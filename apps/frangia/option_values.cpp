#include "option_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/core/parse_length.h"

namespace frangia {
namespace {

std::optional<double> finite(const std::string& input) {
  double number = 0.0;
  if (!CLI::detail::lexical_cast(input, number) || !std::isfinite(number)) return std::nullopt;
  return number;
}

bool is_among(const std::vector<std::string>& words, const std::string& input) {
  return std::find(words.begin(), words.end(), input) != words.end();
}

template <typename IsRight>
CLI::Validator number_that(const IsRight& is_right,
                           const std::string& what,
                           const std::string& help,
                           const std::vector<std::string>& words = {}) {
  return {[=](const std::string& input) {
            const auto number = finite(input);
            const bool right = (number && is_right(*number)) || is_among(words, input);
            return right ? "" : fmt::format("{} is not {}", input, what);
          },
          help};
}

template <typename IsRight>
CLI::Validator length_that(const IsRight& is_right, const char* what) {
  return {[=](std::string& input) {
            try {
              const double length_mm = parse_length_mm(input);
              if (!is_right(length_mm)) return fmt::format("{} is not {}", input, what);
              input = fmt::format("{}", length_mm);
              return std::string();
            } catch (const Error& error) {
              return std::string(error.what());
            }
          },
          "LENGTH"};
}

}  // namespace

CLI::Validator a_length() {
  return length_that([](double) { return true; }, "a length");
}

CLI::Validator length_above_zero() {
  return length_that([](double length_mm) { return length_mm > 0.0; }, "a length above 0");
}

CLI::Validator length_zero_or_more() {
  return length_that([](double length_mm) { return length_mm >= 0.0; }, "a length of 0 or more");
}

CLI::Validator size_above_zero() {
  return {[](std::string& input) {
            constexpr std::array<std::pair<const char*, double>, 4> kUnits{
                {{"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"TB", 1e12}}};
            constexpr double kMax = 1e18;
            double unit = 1.0;
            std::string digits = input;
            for (const auto& [name, bytes] : kUnits) {
              if (!input.ends_with(name)) continue;
              unit = bytes;
              digits = input.substr(0, input.size() - 2);
              digits.erase(digits.find_last_not_of(' ') + 1);
            }
            const double bytes = unit * finite(digits).value_or(0.0);
            if (!(bytes >= 1.0 && bytes <= kMax)) {
              return fmt::format("{} is not a size above 0, such as 500MB or 4GB", input);
            }
            input = fmt::format("{:.0f}", bytes);
            return std::string();
          },
          "SIZE"};
}

CLI::Validator a_number() {
  return number_that([](double) { return true; }, "a number", "");
}

CLI::Validator above_zero(const std::vector<std::string>& words) {
  std::string what = "a number above 0";
  for (const auto& word : words)
    what += (word == words.back() ? " or " : ", ") + word;
  return number_that([](double number) { return number > 0.0; }, what, "POSITIVE", words);
}

CLI::Validator zero_or_more() {
  return number_that(
      [](double number) { return number >= 0.0; }, "a number of 0 or more", "NONNEGATIVE");
}

CLI::Validator from_to(double least, double most) {
  const std::string range = fmt::format("{} to {}", least, most);
  return number_that([=](double number) { return number >= least && number <= most; },
                     "a number from " + range,
                     range);
}

CLI::Validator whole_from_to(std::size_t least, std::size_t most) {
  const std::string range = fmt::format("{} to {}", least, most);
  return {[=](std::string& input) {
            const auto number = finite(input);
            if (!number || *number != std::floor(*number) || *number < static_cast<double>(least) ||
                *number > static_cast<double>(most))
              return fmt::format("{} is not a whole number from {}", input, range);
            input = fmt::format("{:.0f}", *number);
            return std::string();
          },
          range};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return {[words](const std::string& input) {
            return is_among(words, input)
                       ? ""
                       : fmt::format("{} is not one of {}", input, fmt::join(words, ", "));
          },
          ""};
}

CLI::Validator unit_length() {
  return {[](std::string& input) -> std::string {
            const auto unit_mm = parse_unit_mm(input);
            if (!unit_mm) return fmt::format("is \"{}\"; it must be {}", input, kUnitsKnown);
            input = fmt::format("{}", *unit_mm);
            return {};
          },
          ""};
}

}  // namespace frangia
