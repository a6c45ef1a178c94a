#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace frangia {

/// Iterates over the groups of a DXF: a code on one line, its value on the next. Holds a view of
/// the text, which must outlive it.
///
/// @errors   Error(Input) that names the file and the line
class DxfGroups {
 public:
  DxfGroups(std::filesystem::path path, std::string_view text);

  /// Advances to the next group, skipping comments; false at the end of the text.
  bool next();
  [[nodiscard]] int code() const { return code_; }
  /// The value without surrounding white space.
  [[nodiscard]] std::string_view value() const { return value_; }
  [[nodiscard]] bool is(int code, std::string_view value) const {
    return code_ == code && value_ == value;
  }
  [[nodiscard]] double real() const;
  [[nodiscard]] std::int64_t integer() const;
  [[noreturn]] void fail(const std::string& why) const;

 private:
  [[nodiscard]] std::string_view line();

  std::filesystem::path path_;
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t lines_ = 0;
  int code_ = -1;
  std::string_view value_;
};

}  // namespace frangia
