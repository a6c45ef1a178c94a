#include "frangia/files/internal/text_reader.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <system_error>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/files/internal/check_mesh.h"

namespace frangia {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

std::string_view without_plus(std::string_view word) {
  const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
  return plus ? word.substr(1) : word;
}

template <typename Number>
std::errc parse(std::string_view word, Number& number) {
  const std::string_view digits = without_plus(word);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc() && end != digits.data() + digits.size()) {
    return std::errc::invalid_argument;
  }
  return error;
}

/// A number whose exponent another language writes: 1.5D+02 and 1.5+102 of Fortran, 1.5*^2 of
/// Mathematica. Empty for other words.
std::string with_usual_exponent(std::string_view word) {
  constexpr std::size_t kMostDigits = 60;
  if (word.size() < 2 || word.size() > kMostDigits) return {};
  const std::size_t letter = std::min(word.find_first_of("dD", 1), word.find("*^", 1));
  if (letter != std::string_view::npos) {
    const std::size_t behind = letter + (word[letter] == '*' ? 2 : 1);
    return fmt::format("{}e{}", word.substr(0, letter), without_plus(word.substr(behind)));
  }
  const std::size_t sign = word.find_first_of("+-", 1);
  const bool is_bare = sign != std::string_view::npos && word[sign - 1] >= '0' &&
                       word[sign - 1] <= '9' && word.find('.') < sign;
  return is_bare ? fmt::format("{}e{}", word.substr(0, sign), without_plus(word.substr(sign)))
                 : std::string();
}

}  // namespace

std::optional<float> parse_float(std::string_view word) {
  float number = 0.0F;
  const std::errc error = parse(word, number);
  if (error == std::errc()) return number;
  if (const std::string usual = with_usual_exponent(word); !usual.empty())
    return parse_float(usual);
  if (error != std::errc::result_out_of_range) return std::nullopt;
  double wide = 0.0;  // underflow gives zero, overflow infinity
  return parse(word, wide) == std::errc() ? std::optional(static_cast<float>(wide)) : std::nullopt;
}

std::optional<double> parse_double(std::string_view word) {
  double number = 0.0;
  if (parse(word, number) == std::errc()) return number;
  const std::string usual = with_usual_exponent(word);
  return usual.empty() ? std::nullopt : parse_double(usual);
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
  std::int64_t number = 0;
  return parse(word, number) == std::errc() ? std::optional(number) : std::nullopt;
}

std::string_view TextReader::word() {
  for (;;) {
    const std::string_view found = word_on_line();
    if (!found.empty() || position_ == text_.size()) return found;
    skip_line();
  }
}

std::string_view TextReader::word_on_line() {
  position_ = std::min(text_.find_first_not_of(kBlank, position_), text_.size());
  const std::size_t begin = position_;
  const auto ends = [](char c) { return c == '\n' || kBlank.find(c) != std::string_view::npos; };
  while (position_ < text_.size() && !ends(text_[position_]))
    ++position_;
  return text_.substr(begin, position_ - begin);
}

void TextReader::skip_line() {
  const std::size_t newline = text_.find('\n', position_);
  position_ = newline == std::string_view::npos ? text_.size() : newline + 1;
}

float TextReader::real() {
  const std::string_view found = word();
  const std::optional<float> number = parse_float(found);
  if (!number) fail(fmt::format("{} is not a number", in_quotes(found)));
  return *number;
}

std::int64_t TextReader::integer() {
  const std::string_view found = word();
  const std::optional<std::int64_t> number = parse_integer(found);
  if (!number) fail(fmt::format("{} is not a whole number", in_quotes(found)));
  return *number;
}

void TextReader::fail(const std::string& why) const {
  const std::string_view before = text_.substr(0, position_);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  throw Error(ErrorKind::Input,
              fmt::format("{}, line {}: {}{}",
                          path_.string(),
                          line,
                          why,
                          bytes_left() == 0 ? "; the file may be truncated" : ""));
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t kMaxShown = 24;
  if (word.empty()) return "the end";
  std::string shown(word.substr(0, kMaxShown));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return fmt::format("'{}{}'", shown, word.size() > kMaxShown ? "..." : "");
}

std::string without_percent(const std::string& uri) {
  std::string plain;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const char* const digits = uri.data() + i + 1;
    const bool is_escape = uri[i] == '%' && i + 2 < uri.size() &&
                           std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
    plain += is_escape ? static_cast<char>(code) : uri[i];
    if (is_escape) i += 2;
  }
  return plain;
}

std::string read_bytes(const std::filesystem::path& path) {
  std::string bytes = read_text_file(path, std::numeric_limits<std::uint64_t>::max());
  const std::string other = other_kind_of(bytes);
  if (!other.empty()) throw Error(ErrorKind::Input, fmt::format("{}: {}", path.string(), other));
  return bytes;
}

}  // namespace frangia
