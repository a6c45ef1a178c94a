#include "frangia/editor/internal/edit_value.h"

#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parse_length.h"

namespace frangia {
namespace {

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t comma = text.find(',');
    words.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return words;
    text.remove_prefix(comma + 1);
  }
}

std::optional<double> length_of_word(std::string_view word) {
  try {
    return parse_length_mm(word);
  } catch (const Error&) {
    return std::nullopt;  // edit_numbers words the error: it knows the pattern
  }
}

std::optional<double> plain_number(std::string_view kind, std::string_view word) {
  while (!word.empty() && word.front() == ' ')
    word.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const std::string_view unit(end, static_cast<std::size_t>(word.data() + word.size() - end));
  if (error != std::errc() || !(unit.empty() || (kind == "DEG" && unit == "deg"))) {
    return std::nullopt;
  }
  return number;
}

std::optional<double> number_of(std::string_view kind, std::string_view word) {
  const auto number = kind == "MM" ? length_of_word(word) : plain_number(kind, word);
  constexpr double kLargest = 1e9;  // single precision and 32-bit indices hold no larger number
  if (!number || !(std::abs(*number) <= kLargest)) return std::nullopt;
  const bool counts = kind == "N" || kind == "PART" || kind == "HOLE";
  if (counts && (*number < 0.0 || *number != std::floor(*number))) return std::nullopt;
  return number;
}

/// Explains a pattern whose names alone do not say what to write.
std::string_view meaning_of(std::string_view pattern) {
  const auto has = [&](std::string_view kind) {
    return pattern.find(kind) != std::string_view::npos;
  };
  if (has("MM")) return "; a length is in mm or has a unit: 10, 10mm, 1cm, 0.5in";
  if (has("HOLE")) return "; a hole is named by its number in --list: 0";
  return "";
}

}  // namespace

std::vector<double> edit_numbers(std::string_view pattern, const std::string& value) {
  const auto kinds = words_of(pattern);
  const auto words = words_of(value);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < kinds.size() && words.size() == kinds.size(); ++i) {
    const auto number = number_of(kinds[i], words[i]);
    if (number) numbers.push_back(*number);
  }
  if (numbers.size() != kinds.size()) {
    throw Error(ErrorKind::Input,
                fmt::format("'{}' is not {}{}", value, pattern, meaning_of(pattern)));
  }
  return numbers;
}

Eigen::Hyperplane<double, 3> edit_plane(const std::vector<double>& numbers) {
  const Eigen::Vector3d normal(numbers.at(0), numbers.at(1), numbers.at(2));
  require(normal.norm() > 0.0, "a plane's normal must have a length, as in 0,0,1,25mm");
  return {normal.normalized(), -numbers.at(3)};
}

Mark edit_mark(const std::string& value) {
  if (value == "measured") return Mark::Measured;
  if (value == "moved") return Mark::Displaced;
  if (value == "invented") return Mark::Synthesized;
  throw Error(ErrorKind::Input, fmt::format("'{}' is no mark: measured, moved or invented", value));
}

}  // namespace frangia
