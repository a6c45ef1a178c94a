#include "frangia/core/parse_length.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "frangia/core/error.h"

namespace frangia {
namespace {

struct LengthUnit {
  std::string_view name;
  double mm;
};

constexpr std::array<LengthUnit, 8> kLengthUnits{{
    {"", 1.0},
    {"mm", 1.0},
    {"um", 1e-3},
    {"\u00B5m", 1e-3},  // micro sign
    {"\u03BCm", 1e-3},  // Greek letter mu
    {"cm", 10.0},
    {"m", 1000.0},
    {"in", 25.4},
}};

std::string_view without_spaces_around(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

double parse_length_mm(std::string_view text) {
  const std::string_view length = without_spaces_around(text);
  const char* const text_end = length.data() + length.size();
  double number = 0.0;
  const auto [end, error] = std::from_chars(length.data(), text_end, number);
  if (error == std::errc()) {
    const std::string_view name =
        without_spaces_around({end, static_cast<std::size_t>(text_end - end)});
    for (const LengthUnit& unit : kLengthUnits)
      if (name == unit.name && std::isfinite(number * unit.mm)) return number * unit.mm;
  }
  throw Error(ErrorKind::Input,
              "'" + std::string(text) +
                  "' is not a length: write a number and um, mm, cm, m or in, such as 1.5mm");
}

std::optional<double> parse_unit_mm(std::string_view text) {
  constexpr double kFoot_mm = 304.8;
  if (text == "ft") return kFoot_mm;
  std::string length(text);
  if (!text.empty() && text.find_first_of("0123456789") == std::string_view::npos)
    length.insert(length.begin(), '1');  // the name of a unit
  try {
    const double unit_mm = parse_length_mm(length);
    if (unit_mm > 0.0) return unit_mm;
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): it is no length, so it is no unit
  }
  return std::nullopt;
}

}  // namespace frangia
