#include "frangia/dataset/name_template.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr std::size_t kMaxDigits = 9;  // fits into an int

bool is_digit(char letter) {
  return letter >= '0' && letter <= '9';
}

bool same_letter(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

[[noreturn]] void refuse_template(const std::string& text, const std::string& what) {
  throw Error(ErrorKind::Input, fmt::format("`names` is \"{}\", {}", text, what));
}

}  // namespace

NameTemplate::NameTemplate(const std::string& text) : text_(text) {
  std::string literal;
  const auto end_literal = [&] {
    if (!literal.empty()) tokens_.push_back({Kind::Literal, literal, 0});
    literal.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if ((letter == '{' || letter == '}') && i + 1 < text.size() && text[i + 1] == letter) {
      literal += letter;
      ++i;
    } else if (letter == '{') {
      const std::size_t close = text.find('}', i);
      if (close == std::string::npos) refuse_template(text, "in which a { has no }");
      end_literal();
      add_field(text.substr(i + 1, close - i - 1));
      i = close;
    } else if (letter == '}') {
      refuse_template(text, "in which a } has no {; write }} for a brace");
    } else {
      literal += letter;
    }
  }
  end_literal();
  if (tokens_.empty()) refuse_template(text, "which fits no file");
}

void NameTemplate::add_field(const std::string& field) {
  const std::size_t colon = field.find(':');
  const std::string name = field.substr(0, colon);
  std::string width = colon == std::string::npos ? "" : field.substr(colon + 1);
  static const std::map<std::string, Kind> kKinds = {{"pattern", Kind::PatternText},
                                                     {"camera", Kind::CameraText},
                                                     {"*", Kind::AnyText},
                                                     {"frame", Kind::FrameNumber},
                                                     {"view", Kind::ViewNumber}};
  const auto kind = kKinds.find(name);
  if (kind == kKinds.end()) {
    refuse_template(
        text_,
        fmt::format("in which {{{}}} is unknown; fields are {{pattern}}, {{camera}}, {{frame}}, "
                    "{{view}} and {{*}}",
                    field));
  }
  if (has(kind->second) && kind->second != Kind::AnyText)
    refuse_template(text_, fmt::format("in which {{{}}} occurs twice", name));
  if (width.ends_with('d')) width.pop_back();
  const bool number = width.size() <= 2 && std::all_of(width.begin(), width.end(), is_digit);
  const std::size_t digits = number && !width.empty() ? std::stoul(width) : 0;
  if (!number || digits > kMaxDigits ||
      (kind->second != Kind::FrameNumber && kind->second != Kind::ViewNumber && digits > 0)) {
    refuse_template(
        text_,
        fmt::format("in which {{{}}} has no valid width; write a number as in {{frame:02}}",
                    field));
  }
  tokens_.push_back({kind->second, "", digits});
}

bool NameTemplate::has(Kind kind) const {
  return std::any_of(
      tokens_.begin(), tokens_.end(), [&](const Token& token) { return token.kind == kind; });
}

int NameTemplate::depth() const {
  int depth = 0;
  for (const Token& token : tokens_)
    depth += static_cast<int>(std::count(token.literal.begin(), token.literal.end(), '/'));
  return depth;
}

/// The state of a search for all readings of a name.
struct NameTemplate::Search {
  const std::string& name;
  const std::vector<std::string>& patterns;
  NameFields fields{};
  int inexact = 0;  ///< numbers with more digits than stated
  std::vector<std::pair<int, NameFields>> found{};
};

void NameTemplate::read_on(std::size_t token, std::size_t at, Search& search) const {
  const std::string& name = search.name;
  if (token == tokens_.size()) {
    if (at == name.size()) search.found.emplace_back(search.inexact, search.fields);
    return;
  }
  const Token& now = tokens_[token];
  if (now.kind == Kind::Literal) {
    const bool fits = name.size() - at >= now.literal.size() &&
                      std::equal(now.literal.begin(),
                                 now.literal.end(),
                                 name.begin() + static_cast<std::ptrdiff_t>(at),
                                 same_letter);
    if (fits) read_on(token + 1, at + now.literal.size(), search);
    return;
  }
  if (now.kind == Kind::FrameNumber || now.kind == Kind::ViewNumber) {
    read_number(token, at, search);
  } else {
    read_text(token, at, search);
  }
}

void NameTemplate::read_text(std::size_t token, std::size_t at, Search& search) const {
  const std::string& name = search.name;
  const Kind kind = tokens_[token].kind;
  const bool is_pattern = kind == Kind::PatternText;
  std::string ignored;
  std::string& field = is_pattern              ? search.fields.pattern
                       : kind == Kind::AnyText ? ignored
                                               : search.fields.camera;
  for (std::size_t end = at + 1; end <= name.size() && name[end - 1] != '/'; ++end) {
    field = name.substr(at, end - at);
    const bool known =
        !is_pattern || search.patterns.empty() ||
        std::find(search.patterns.begin(), search.patterns.end(), field) != search.patterns.end();
    if (known) read_on(token + 1, end, search);
  }
}

void NameTemplate::read_number(std::size_t token, std::size_t at, Search& search) const {
  const Token& now = tokens_[token];
  const std::string& name = search.name;
  std::optional<int>& field =
      now.kind == Kind::FrameNumber ? search.fields.frame : search.fields.view;
  int value = 0;
  for (std::size_t digits = 1; digits <= kMaxDigits && at + digits <= name.size(); ++digits) {
    const char letter = name[at + digits - 1];
    if (!is_digit(letter)) return;
    value = 10 * value + (letter - '0');
    const bool longer = now.width > 0 && digits > now.width;
    if (digits < now.width || (longer && name[at] == '0')) continue;
    field = value;
    search.inexact += longer ? 1 : 0;
    read_on(token + 1, at + digits, search);
    search.inexact -= longer ? 1 : 0;
  }
}

std::vector<NameFields> NameTemplate::match(const std::string& name,
                                            const std::vector<std::string>& patterns) const {
  Search search{name, patterns};
  read_on(0, 0, search);
  int least = static_cast<int>(tokens_.size());
  for (const auto& [inexact, fields] : search.found)
    least = std::min(least, inexact);
  std::vector<NameFields> readings;
  for (const auto& [inexact, fields] : search.found) {
    const bool is_new = std::find(readings.begin(), readings.end(), fields) == readings.end();
    if (inexact == least && is_new) readings.push_back(fields);
  }
  return readings;
}

bool is_before_in_natural_order(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
      continue;
    }
    const auto number = [](const std::string& text, std::size_t& at) {
      while (at < text.size() && text[at] == '0')
        ++at;
      const std::size_t begin = at;
      while (at < text.size() && is_digit(text[at]))
        ++at;
      return std::string_view(text).substr(begin, at - begin);
    };
    const std::string_view first = number(a, i);
    const std::string_view second = number(b, j);
    if (first.size() != second.size()) return first.size() < second.size();
    if (first != second) return first < second;
  }
  return a.size() - i < b.size() - j;
}

}  // namespace frangia
