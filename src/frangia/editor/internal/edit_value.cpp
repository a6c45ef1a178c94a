#include "frangia/editor/internal/edit_value.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/parse_length.h"

namespace frangia {
namespace {

enum class ValueUnit { None, Length, Degrees };
enum class ValueRange { Any, NotNegative, Positive };

/// One word of a pattern and the numbers that it stands for.
struct ValueKind {
  std::string_view name;
  ValueUnit unit = ValueUnit::None;
  ValueRange range = ValueRange::Any;
  bool whole = false;
  std::string_view help;
};

constexpr ValueKind kPlainNumber{.name = "", .help = ""};

constexpr std::string_view kLengthHelp = "; a length is in mm or has a unit: 10, 10mm, 1cm, 0.5in";

constexpr std::array<ValueKind, 9> kValueKinds{{
    {.name = "MM", .unit = ValueUnit::Length, .help = kLengthHelp},
    {.name = "SIZE",
     .unit = ValueUnit::Length,
     .range = ValueRange::Positive,
     .help = "; a size is a length greater than 0, in mm or with a unit: 10, 10mm, 1cm, 0.5in"},
    {.name = "TOLERANCE",
     .unit = ValueUnit::Length,
     .range = ValueRange::NotNegative,
     .help = "; a tolerance is a length of at least 0, in mm or with a unit: 0.1, 0.1mm, 100um"},
    {.name = "DEG", .unit = ValueUnit::Degrees, .range = ValueRange::Positive, .help = ""},
    {.name = "N",
     .range = ValueRange::Positive,
     .whole = true,
     .help = "; write a whole number greater than 0"},
    {.name = "COMPONENT",
     .range = ValueRange::NotNegative,
     .whole = true,
     .help = "; write the number that `list` shows for the component: 0"},
    {.name = "HOLE",
     .range = ValueRange::NotNegative,
     .whole = true,
     .help = "; write the number that `list` shows for the hole: 0"},
    {.name = "K", .range = ValueRange::NotNegative, .help = "; write a number of at least 0"},
    {.name = "PER_MM", .range = ValueRange::NotNegative, .help = "; write a number of at least 0"},
}};

const ValueKind& kind_of(std::string_view name) {
  for (const ValueKind& kind : kValueKinds)
    if (kind.name == name) return kind;
  return kPlainNumber;
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
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

std::optional<double> number_of_word(ValueUnit unit, std::string_view word) {
  if (unit == ValueUnit::Length) return length_of_word(word);
  while (!word.empty() && word.front() == ' ')
    word.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  const std::string_view suffix(end, static_cast<std::size_t>(word.data() + word.size() - end));
  const bool known_suffix = suffix.empty() || (unit == ValueUnit::Degrees && suffix == "deg");
  if (error != std::errc() || !known_suffix) return std::nullopt;
  return number;
}

bool is_in_range(const ValueKind& kind, double number) {
  constexpr double kLargest = 1e9;    // counts stay below 2^31, coordinates in single precision
  constexpr double kSmallest = 1e-6;  // mm or degrees; squares and inverses of it are no trouble
  if (!(std::abs(number) <= kLargest)) return false;
  if (kind.whole && number != std::floor(number)) return false;
  if (kind.range == ValueRange::Positive) return number >= kSmallest;
  return kind.range == ValueRange::Any || number >= 0.0;
}

/// Scripts, histories and the state of the app hold the texts of values.
void require_short(std::string_view value, std::size_t numbers) {
  constexpr std::size_t kMostLetters = 40;  // of a number with its unit
  if (value.size() <= numbers * kMostLetters) return;
  throw Error(ErrorKind::Input,
              fmt::format("the value has {} letters, more than {} numbers need; shorten it",
                          value.size(),
                          numbers));
}

std::string_view help_for(std::string_view pattern) {
  for (const std::string_view word : split_at_commas(pattern))
    if (!kind_of(word).help.empty()) return kind_of(word).help;
  return "";
}

}  // namespace

std::vector<double> edit_numbers(std::string_view pattern, const std::string& value) {
  const auto names = split_at_commas(pattern);
  require_short(value, names.size());
  const auto words = split_at_commas(value);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < names.size() && words.size() == names.size(); ++i) {
    const ValueKind& kind = kind_of(names[i]);
    const auto number = number_of_word(kind.unit, words[i]);
    if (number && is_in_range(kind, *number)) numbers.push_back(*number);
  }
  if (numbers.size() != names.size()) {
    throw Error(ErrorKind::Input,
                fmt::format("'{}' is not {}{}", value, pattern, help_for(pattern)));
  }
  return numbers;
}

Eigen::Hyperplane<double, 3> edit_plane(const std::vector<double>& numbers) {
  const Eigen::Vector3d normal(numbers.at(0), numbers.at(1), numbers.at(2));
  require(normal.norm() > 0.0,
          "the normal of the plane has no length; write a direction, such as 0,0,1,25mm");
  return {normal.normalized(), -numbers.at(3)};
}

ViewedOutline edit_outline(const std::string& value) {
  constexpr std::size_t kMostCorners = 4096;
  constexpr std::size_t kCoordinates = 3;
  require_short(value, (kMostCorners + 1) * kCoordinates);
  const auto words = split_at_commas(value);
  std::vector<double> numbers;
  for (const std::string_view word : words) {
    if (words.size() > (kMostCorners + 1) * kCoordinates) break;
    const auto number = number_of_word(ValueUnit::Length, word);
    if (number && is_in_range(kPlainNumber, *number)) numbers.push_back(*number);
  }
  if (numbers.size() != words.size() || numbers.size() % kCoordinates != 0 ||
      numbers.size() < 4 * kCoordinates) {
    throw Error(ErrorKind::Input,
                fmt::format("the value is not {}; write the point of view and 3 to {} corners of "
                            "the outline, three coordinates each",
                            kOutlinePattern,
                            kMostCorners));
  }
  ViewedOutline outline;
  outline.eye_mm = {numbers[0], numbers[1], numbers[2]};
  for (std::size_t i = kCoordinates; i < numbers.size(); i += kCoordinates)
    outline.corners_mm.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  return outline;
}

Mark edit_mark(const std::string& value) {
  if (const auto mark = find_named<Mark>(value)) return *mark;
  throw Error(ErrorKind::Input,
              fmt::format("'{}' is not a mark; write {}", value, listed_names<Mark>()));
}

}  // namespace frangia
