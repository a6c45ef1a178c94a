#pragma once

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "frangia/core/durable_file.h"

namespace frangia {

/// Writes a TOML file with its keys in the order of the calls; a toml::table would sort them.
///
/// toml++ writes strings, integers and booleans. Floating-point numbers are written in the fewest
/// digits that restore them, because people edit these files and toml++ writes 0.1 as
/// 0.10000000000000001. Include it in sources only, because it includes toml++.
class TomlWriter {
 public:
  /// Begins [name].
  void begin_table(std::string_view name) { text_ << "\n[" << name << "]\n"; }
  /// Begins the next [[name]].
  void begin_table_of_list(std::string_view name) { text_ << "\n[[" << name << "]]\n"; }

  /// Writes a string, an integer or a boolean.
  template <typename T>
  void put(std::string_view key, const T& value) {
    const toml::value node(value);
    toml::toml_formatter in_double_quotes(
        node, toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings);
    text_ << key << " = " << in_double_quotes << '\n';
  }
  /// Writes a number.
  void put(std::string_view key, double value) { text_ << key << " = " << text_of(value) << '\n'; }
  /// Writes a list of numbers.
  void put(std::string_view key, const std::vector<double>& values) {
    text_ << key << " = " << text_of(values) << '\n';
  }
  /// Writes a list of strings.
  void put(std::string_view key, const std::vector<std::string>& values) {
    text_ << key << " = [";
    for (std::size_t i = 0; i < values.size(); ++i) {
      const toml::value<std::string> node(values[i]);
      toml::toml_formatter in_double_quotes(
          node, toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings);
      text_ << (i > 0 ? ", " : "") << in_double_quotes;
    }
    text_ << "]\n";
  }
  /// Writes a list of integers.
  void put(std::string_view key, const std::vector<int>& values) {
    text_ << key << fmt::format(" = [{}]\n", fmt::join(values, ", "));
  }
  /// Writes a list of lists of numbers.
  void put(std::string_view key, const std::vector<std::vector<double>>& rows) {
    text_ << key << " = [";
    for (std::size_t row = 0; row < rows.size(); ++row)
      text_ << (row > 0 ? ", " : "") << text_of(rows[row]);
    text_ << "]\n";
  }

  /// Returns the content of the file.
  [[nodiscard]] std::string text() const { return text_.str(); }

  /// Writes the file.
  ///
  /// @errors   Error(File) when it cannot be written
  void save(const std::filesystem::path& path, Durability durability = Durability::Buffered) const {
    AtomicFile file(path, durability);
    file.stream() << text_.str();
    file.commit();
  }

 private:
  /// The shortest decimal that restores the number, with a point or an exponent.
  static std::string text_of(double value) {
    std::string text = fmt::format("{}", value);
    if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
    return text;
  }
  static std::string text_of(const std::vector<double>& values) {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + text_of(value);
    return '[' + text + ']';
  }

  std::ostringstream text_;
};

/// `value` to a number of significant digits, so that 120 degrees are not written as
/// 120.00000000000001.
[[nodiscard]] inline double rounded_to_digits(double value, int digits) {
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

}  // namespace frangia
