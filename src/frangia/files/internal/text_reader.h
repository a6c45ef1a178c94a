#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace frangia {

/// Parses a whole word as a number; nothing when it is not one. Infinity and NaN are accepted, and
/// exponents as Fortran and Mathematica write them.
[[nodiscard]] std::optional<float> parse_float(std::string_view word);
[[nodiscard]] std::optional<double> parse_double(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);

/// Iterates over the words of a text. Holds a view of the text, which must outlive it.
///
/// @errors   Error(Input) that names the file and the line
class TextReader {
 public:
  TextReader(std::filesystem::path path, std::string_view text)
      : path_(std::move(path)), text_(text) {}

  /// The next word, on this line or a later one; empty at the end of the text.
  [[nodiscard]] std::string_view word();
  /// The next word of this line; empty at its end.
  [[nodiscard]] std::string_view word_on_line();
  void skip_line();

  /// The next word as a number; fails when it is not one.
  [[nodiscard]] float real();
  [[nodiscard]] std::int64_t integer();

  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::size_t bytes_left() const { return text_.size() - position_; }
  [[nodiscard]] std::string_view rest() const { return text_.substr(position_); }
  [[noreturn]] void fail(const std::string& why) const;

 private:
  std::filesystem::path path_;
  std::string_view text_;
  std::size_t position_ = 0;
};

/// A word for a message: quoted, shortened, without control characters; "the end" for an empty
/// word.
[[nodiscard]] std::string in_quotes(std::string_view word);

/// A uri, or the name of a part of a package, with its escapes, such as %20 for a blank, replaced.
[[nodiscard]] std::string without_percent(const std::string& uri);

/// Reads a whole file of any size.
///
/// @errors   Error(Input) that names the file: it does not exist, is not a regular file, cannot be
///          read, or is packed or of a kind that no reader of meshes takes
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

}  // namespace frangia
