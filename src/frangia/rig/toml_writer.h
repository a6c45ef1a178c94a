#pragma once

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "frangia/core/atomic_file.h"

namespace frangia {

/// Writes a TOML file whose values toml++ formats. Keys stay in the order of the calls, which a
/// toml::table would sort. Include it in sources only, because it includes toml++.
class TomlWriter {
 public:
  /// Begins [name].
  void begin_table(std::string_view name) { text_ << "\n[" << name << "]\n"; }
  /// Begins the next [[name]].
  void begin_table_of_list(std::string_view name) { text_ << "\n[[" << name << "]]\n"; }

  /// Writes a string, a number or a boolean.
  template <typename T>
  void put(std::string_view key, const T& value) {
    text_ << key << " = " << toml::value(value) << '\n';
  }
  /// Writes a list; a long one takes several lines.
  void put(std::string_view key, const toml::array& values) {
    text_ << key << " = " << values << '\n';
  }
  /// Writes a list of numbers.
  void put(std::string_view key, const std::vector<double>& values) {
    toml::array list;
    for (const double value : values)
      list.push_back(value);
    put(key, list);
  }

  /// Writes the file.
  ///
  /// @errors   Error(File) when it cannot be written
  void save(const std::filesystem::path& path) const {
    AtomicFile file(path);
    file.stream() << text_.str();
    file.commit();
  }

 private:
  std::ostringstream text_;
};

/// `value` to a number of significant digits, so that 120 degrees are not written as
/// 120.00000000000001.
[[nodiscard]] inline double rounded_to_digits(double value, int digits) {
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

}  // namespace frangia
