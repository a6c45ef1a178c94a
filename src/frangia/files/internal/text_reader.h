#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace frangia {

/// The number that a word is, in full; nothing when it is not one. Any spelling of infinity or NaN
/// is a number here.
[[nodiscard]] std::optional<float> parse_float(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);

/// Walks over the words of a text file. It keeps a view: the text must outlive it.
///
/// errors   Error(Input) that names the file and the line
class TextReader {
 public:
  TextReader(std::filesystem::path path, std::string_view text)
      : path_(std::move(path)), text_(text) {}

  /// The next word, on this line or a later one; empty at the end of the text.
  [[nodiscard]] std::string_view word();
  /// The next word of this line; empty at the line's end.
  [[nodiscard]] std::string_view word_on_line();
  void skip_line();

  /// The next word, which must be this number.
  [[nodiscard]] float real();
  [[nodiscard]] std::int64_t integer();

  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::size_t bytes_left() const { return text_.size() - position_; }
  [[noreturn]] void fail(const std::string& why) const;

 private:
  std::filesystem::path path_;
  std::string_view text_;
  std::size_t position_ = 0;
};

/// A word as an error may show it: short, in quotes, fit for a terminal; "the end" for no word.
[[nodiscard]] std::string in_quotes(std::string_view word);

}  // namespace frangia
