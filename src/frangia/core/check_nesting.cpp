#include "frangia/core/check_nesting.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {
namespace {

constexpr int kMaxNesting = 100;  // toml++ overflows a stack of 8 MB at about 20 000 levels
constexpr std::size_t kMaxJsonValues = 1'000'000;  // a parsed value takes up to 150 bytes
constexpr int kMaxKeyParts = 100;                  // each part of a dotted key is one level

class NestingScanner {
 public:
  NestingScanner(std::string_view text, const std::filesystem::path& file)
      : text_(text), file_(file) {}

  void scan_json() {
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        skip_string("\"", true);
      } else {
        count_value();
        count_bracket();
      }
    }
  }

  /// A text that is not valid TOML may be scanned wrongly behind its first error, which the parser
  /// does not pass.
  void scan_toml() {
    for (; at_ < text_.size(); ++at_) {
      switch (text_[at_]) {
        case '#':
          at_ = std::min(text_.find('\n', at_), text_.size() - 1);
          key_parts_ = 0;
          break;
        case '"':
          skip_string(at("\"\"\"") ? "\"\"\"" : "\"", true);
          break;
        case '\'':
          skip_string(at("'''") ? "'''" : "'", false);
          break;
        case '.':
          if (++key_parts_ >= kMaxKeyParts)
            fail(fmt::format("a key has more than {} dotted parts", kMaxKeyParts));
          break;
        case '\n':
        case '=':
        case ',':
          key_parts_ = 0;
          break;
        default:
          count_bracket();
      }
    }
  }

 private:
  /// Every value but the first one follows a bracket or a comma.
  void count_value() {
    const char letter = text_[at_];
    if (letter != ',' && letter != '[' && letter != '{') return;
    if (++values_ > kMaxJsonValues)
      fail(fmt::format("it holds more than {} values", kMaxJsonValues));
  }

  [[nodiscard]] bool at(std::string_view word) const {
    return text_.substr(at_, word.size()) == word;
  }

  void count_bracket() {
    const char letter = text_[at_];
    if (letter == '[' || letter == '{') {
      key_parts_ = 0;
      if (++depth_ > kMaxNesting)
        fail(fmt::format("brackets are nested more than {} deep", kMaxNesting));
    } else if (letter == ']' || letter == '}') {
      key_parts_ = 0;
      depth_ = std::max(0, depth_ - 1);
    }
  }

  /// Moves to the last character of a string. A string of one line ends at its end.
  void skip_string(std::string_view quote, bool escapes) {
    at_ += quote.size();
    while (at_ < text_.size() && !at(quote)) {
      if (quote.size() == 1 && text_[at_] == '\n') {
        --at_;
        return;
      }
      at_ += std::size_t{escapes && text_[at_] == '\\' ? 2U : 1U};
    }
    at_ += quote.size() - 1;
    if (quote.size() == 1) return;
    // A string of several lines may have one or two quotes of its own before its last three.
    constexpr int kMaxOwnQuotes = 2;
    for (int i = 0; i < kMaxOwnQuotes && at_ + 1 < text_.size(); ++i) {
      if (text_[at_ + 1] != quote.front()) return;
      ++at_;
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n');
    throw Error(ErrorKind::Input,
                fmt::format("{}: line {}: {}; correct the file", file_.string(), line, what));
  }

  std::string_view text_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int key_parts_ = 0;
  std::size_t values_ = 0;
};

}  // namespace

void check_json_nesting(std::string_view text, const std::filesystem::path& file) {
  NestingScanner(text, file).scan_json();
}

void check_toml_nesting(std::string_view text, const std::filesystem::path& file) {
  NestingScanner(text, file).scan_toml();
}

}  // namespace frangia
