#include "frangia/files/internal/text_reader.h"

#include <algorithm>
#include <charconv>
#include <system_error>

#include <fmt/format.h>

#include "frangia/core/error.h"

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

}  // namespace

std::optional<float> parse_float(std::string_view word) {
  float number = 0.0F;
  const std::errc error = parse(word, number);
  if (error == std::errc()) return number;
  constexpr std::size_t kMostDigits = 60;
  const std::size_t exponent = word.find_first_of("dD");  // as Fortran writes doubles
  if (exponent != std::string_view::npos && exponent > 0 && word.size() < kMostDigits) {
    std::string usual(word);
    usual[exponent] = 'e';
    return parse_float(usual);
  }
  if (error != std::errc::result_out_of_range) return std::nullopt;
  double wide = 0.0;  // underflow gives zero, overflow infinity
  return parse(word, wide) == std::errc() ? std::optional(static_cast<float>(wide)) : std::nullopt;
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

}  // namespace frangia
