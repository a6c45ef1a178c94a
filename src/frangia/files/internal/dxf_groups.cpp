#include "frangia/files/internal/dxf_groups.h"

#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/files/internal/text_reader.h"

namespace frangia {
namespace {

constexpr std::string_view kAroundValues = " \t\r\v\f";
constexpr int kComment = 999;

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(kAroundValues);
  if (begin == std::string_view::npos) return {};
  return line.substr(begin, line.find_last_not_of(kAroundValues) - begin + 1);
}

}  // namespace

DxfGroups::DxfGroups(std::filesystem::path path, std::string_view text)
    : path_(std::move(path)), text_(text) {}

std::string_view DxfGroups::line() {
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  const std::string_view found = text_.substr(position_, end - position_);
  position_ = std::min(end + 1, text_.size());
  ++lines_;
  return trimmed(found);
}

bool DxfGroups::next() {
  do {
    if (position_ == text_.size()) return false;
    const std::string_view code = line();
    if (code.empty() && position_ == text_.size()) return false;
    const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), code_);
    if (error != std::errc() || end != code.data() + code.size()) {
      fail(fmt::format("expected the code of a group, found {}", in_quotes(code)));
    }
    if (position_ == text_.size()) fail("the last group has no value; the file is truncated");
    value_ = line();
  } while (code_ == kComment);
  return true;
}

double DxfGroups::real() const {
  const std::optional<double> number = parse_double(value_);
  if (!number) fail(fmt::format("{} is not a number", in_quotes(value_)));
  return *number;
}

std::int64_t DxfGroups::integer() const {
  const auto number = parse_integer(value_);
  if (!number) fail(fmt::format("{} is not a whole number", in_quotes(value_)));
  return *number;
}

void DxfGroups::fail(const std::string& why) const {
  throw Error(ErrorKind::Input, fmt::format("{}, line {}: {}", path_.string(), lines_, why));
}

}  // namespace frangia
