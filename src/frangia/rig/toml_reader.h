#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "frangia/core/check_nesting.h"
#include "frangia/core/enum_names.h"
#include "frangia/core/error.h"
#include "frangia/core/read_file.h"
#include "frangia/core/run.h"
#include "frangia/core/text.h"

namespace frangia {

/// Reads one table of a TOML file. Error messages name the file and the key, and of a table of a
/// list its own name, where it has one: `"spacing": characteristics[3].limit`. Include it in
/// sources only, because it includes toml++.
class TomlReader {
 public:
  /// `table_name` is the prefix of keys in messages; `table` must outlive the reader.
  TomlReader(std::filesystem::path file, std::string table_name, const toml::table& table)
      : file_(std::move(file)), table_name_(std::move(table_name)), table_(&table) {}

  /// Throws Error(Input) with "FILE: KEY WHAT" or "FILE: "NAME": KEY WHAT".
  [[noreturn]] void fail(std::string_view key, std::string_view what) const {
    throw Error(ErrorKind::Input, fmt::format("{}: {} {}", file_.string(), shown(key), what));
  }
  /// Warns with a sentence of the same form.
  void warn(std::string_view key, std::string_view what, const Run& run) const {
    run.warn(fmt::format("{}: {} {}", file_.string(), shown(key), what));
  }
  /// Whether the table contains the key.
  [[nodiscard]] bool has(std::string_view key) const {
    known_.insert(std::string(key));
    return table_->contains(key);
  }

  /// Finite number; the key is required.
  [[nodiscard]] double number(std::string_view key) { return finite(key, node(key)); }
  /// Returns a finite number, or `fallback` if the key is missing.
  [[nodiscard]] double number_or(std::string_view key, double fallback) {
    return has(key) ? number(key) : fallback;
  }
  /// Returns a number above 0; the key is required.
  [[nodiscard]] double positive(std::string_view key) {
    const double value = number(key);
    if (value <= 0.0) fail(key, fmt::format("is {}; it must be above 0", value));
    return value;
  }
  /// Returns a whole number from `minimum` to `maximum`; the key is required.
  [[nodiscard]] int integer(std::string_view key, int minimum, int maximum) {
    const auto value = node(key).value_exact<std::int64_t>();
    if (!value) fail(key, "must be a whole number");
    if (*value < minimum || *value > maximum) {
      fail(key, fmt::format("is {}; it must lie between {} and {}", *value, minimum, maximum));
    }
    return static_cast<int>(*value);
  }
  /// Whether the key is present and a boolean.
  [[nodiscard]] bool is_boolean(std::string_view key) const {
    return has(key) && table_->get(key)->is_boolean();
  }
  /// Returns a boolean; the key is required.
  [[nodiscard]] bool boolean(std::string_view key) {
    const auto value = node(key).value_exact<bool>();
    if (!value) fail(key, "must be true or false");
    return *value;
  }
  /// Returns a string; the key is required.
  [[nodiscard]] std::string text(std::string_view key) {
    const auto value = node(key).value_exact<std::string>();
    if (!value) fail(key, "must be a string in quotes");
    return *value;
  }
  /// Returns the value that a name stands for; the key is required.
  template <NamedEnum Enum>
  [[nodiscard]] Enum named(std::string_view key) {
    const std::string word = text(key);
    if (const auto value = find_named<Enum>(word)) return *value;
    fail(key, fmt::format("is \"{}\"; it must be {}", word, listed_names<Enum>()));
  }
  /// Returns a list of strings, which may be empty; the key is required.
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) {
    const toml::array* list = node(key).as_array();
    if (list == nullptr) fail(key, "must be a list of strings");
    std::vector<std::string> values;
    for (const auto& item : *list) {
      const auto value = item.value_exact<std::string>();
      if (!value) fail(key, "must be a list of strings in quotes");
      values.push_back(*value);
    }
    return values;
  }
  /// Returns a list of numbers, of exactly `count` numbers unless `count` is 0.
  [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t count = 0) {
    const toml::array* list = node(key).as_array();
    if (list == nullptr || (count != 0 && list->size() != count)) {
      fail(key,
           count == 0 ? "must be a list of numbers"
                      : fmt::format("must be a list of {} numbers", count));
    }
    std::vector<double> values;
    for (const auto& item : *list)
      values.push_back(finite(key, item));
    return values;
  }
  /// Returns `count` lists of `length` numbers each.
  [[nodiscard]] std::vector<std::vector<double>> rows(std::string_view key,
                                                      std::size_t count,
                                                      std::size_t length) {
    const std::string wanted = fmt::format("must be {} lists of {} numbers", count, length);
    const toml::array* list = node(key).as_array();
    if (list == nullptr || list->size() != count) fail(key, wanted);
    std::vector<std::vector<double>> values;
    for (const auto& item : *list) {
      const toml::array* row = item.as_array();
      if (row == nullptr || row->size() != length) fail(key, wanted);
      values.emplace_back();
      for (const auto& number : *row)
        values.back().push_back(finite(key, number));
    }
    return values;
  }
  /// Returns the reader of a required inner table.
  [[nodiscard]] TomlReader table(std::string_view key) {
    const toml::table* inner = node(key).as_table();
    if (inner == nullptr) fail(key, fmt::format("must be a table, [{}]", key));
    TomlReader reader{file_, name(key), *inner};
    reader.item_name_ = item_name_;
    return reader;
  }
  /// Returns the tables of [[key]]; empty if the key is absent.
  [[nodiscard]] std::vector<TomlReader> tables(std::string_view key) {
    std::vector<TomlReader> readers;
    if (!has(key)) return readers;
    const toml::array* list = node(key).as_array();
    if (list == nullptr) fail(key, fmt::format("must be written as [[{}]]", key));
    for (const auto& item : *list) {
      const toml::table* inner = item.as_table();
      if (inner == nullptr) fail(key, fmt::format("must be written as [[{}]]", key));
      readers.emplace_back(file_, fmt::format("{}[{}]", key, readers.size()), *inner);
      readers.back().item_name_ = (*inner)["name"].value_exact<std::string>().value_or("");
    }
    return readers;
  }
  /// Keys of the table, in alphabetical order.
  [[nodiscard]] std::vector<std::string> keys() const {
    std::vector<std::string> names;
    for (const auto& [key, value] : *table_)
      names.emplace_back(key.str());
    return names;
  }
  /// Accepts a key without reading it, so that no warning follows.
  void ignore(std::string_view key) {
    used_.insert(std::string(key));
    known_.insert(std::string(key));
  }

  /// Refuses each key that was not read. For tables in which a default replaces a missing key.
  ///
  /// @errors   Error(Input) that names the key and the nearest known one, or all
  void refuse_unused_keys() const {
    for (const std::string& key : unused_keys())
      fail(key, fmt::format("is unknown here{}", meant(key).value_or(known())));
  }
  /// Warns about each key that was not read. One that is a known key but for a few letters is
  /// refused, because the default would replace what it states.
  ///
  /// @errors   Error(Input) that names the key and the known one
  void warn_of_unused_keys(const Run& run) const {
    for (const std::string& key : unused_keys()) {
      if (const auto known_key = meant(key)) fail(key, "is unknown here" + *known_key);
      run.warn(fmt::format("{}: {} is unknown and ignored", file_.string(), shown(key)));
    }
  }

 private:
  /// A key behind the name of its table, for people.
  [[nodiscard]] std::string shown(std::string_view key) const {
    constexpr std::size_t kLongest =
        80;  // a longer one, or one with control characters, is no name
    const bool is_name = !item_name_.empty() && item_name_.size() <= kLongest &&
                         std::none_of(item_name_.begin(), item_name_.end(), [](char c) {
                           return static_cast<unsigned char>(c) < 0x20U || c == 0x7F;
                         });
    return is_name ? fmt::format("\"{}\": {}", item_name_, name(key)) : name(key);
  }
  [[nodiscard]] std::string name(std::string_view key) const {
    return table_name_.empty() ? std::string(key) : fmt::format("{}.{}", table_name_, key);
  }
  [[nodiscard]] std::vector<std::string> unused_keys() const {
    std::vector<std::string> names = keys();
    std::erase_if(names, [&](const std::string& key) { return used_.contains(key); });
    return names;
  }
  /// The advice for a key that is nearly one that this table may have and has not.
  [[nodiscard]] std::optional<std::string> meant(const std::string& key) const {
    std::vector<std::string> missing;
    std::copy_if(known_.begin(), known_.end(), std::back_inserter(missing), [&](const auto& one) {
      return !table_->contains(one);
    });
    const auto nearest = nearest_name(key, missing);
    if (!nearest) return std::nullopt;
    return fmt::format("; perhaps {} was meant: rename it, or leave it out", *nearest);
  }
  /// The advice with all keys that were asked for.
  [[nodiscard]] std::string known() const {
    return fmt::format("; leave it out. The keys are {}", fmt::join(known_, ", "));
  }
  [[nodiscard]] const toml::node& node(std::string_view key) {
    used_.insert(std::string(key));
    known_.insert(std::string(key));
    const toml::node* found = table_->get(key);
    if (found == nullptr) fail(key, "is missing" + misspelt(key).value_or(""));
    return *found;
  }
  /// The advice for a missing key where the table has one that was not asked for and is nearly it.
  [[nodiscard]] std::optional<std::string> misspelt(std::string_view key) const {
    std::vector<std::string> others = keys();
    std::erase_if(others, [&](const std::string& one) { return known_.contains(one); });
    const auto nearest = nearest_name(key, others);
    if (!nearest) return std::nullopt;
    return fmt::format("; perhaps {} is meant as {}: rename it", *nearest, key);
  }
  [[nodiscard]] double finite(std::string_view key, const toml::node& item) const {
    const auto value = item.value<double>();
    if (!value || item.is_boolean()) fail(key, "must be a number");
    if (!std::isfinite(*value)) fail(key, fmt::format("is {}; it must be a finite number", *value));
    return *value;
  }

  std::filesystem::path file_;
  std::string table_name_;
  std::string item_name_;  ///< that a table of a list has; empty: none
  const toml::table* table_;
  std::set<std::string> used_;
  mutable std::set<std::string> known_;  ///< all that were asked for, in the table or not
};

/// Parses TOML. `file` is named in messages.
///
/// @errors   Error(Input) that names the line
[[nodiscard]] inline toml::table parse_toml_text(const std::string& text,
                                                 const std::filesystem::path& file) {
  check_toml_nesting(text, file);
  try {
    return toml::parse(text, file.string());
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::Input,
                fmt::format("{}: line {}: {}",
                            file.string(),
                            error.source().begin.line,
                            std::string(error.description())));
  }
}

/// Parses the text of a file whose `format` key must equal `format` and whose version must be from
/// 1 to `newest_version`.
///
/// @errors   Error(Input) that names the file and the line or key
[[nodiscard]] inline toml::table parse_toml_text_as(const std::string& text,
                                                    const std::filesystem::path& file,
                                                    const std::string& format,
                                                    int newest_version = 1) {
  toml::table table = parse_toml_text(text, file);
  TomlReader reader(file, "", table);
  if (reader.text("format") != format) reader.fail("format", fmt::format("must be \"{}\"", format));
  const int version = reader.integer("version", 1, std::numeric_limits<int>::max());
  if (version > newest_version) {
    reader.fail("version",
                fmt::format("is {}, but this program reads versions up to {}: update the program",
                            version,
                            newest_version));
  }
  return table;
}

/// Reads a file and parses it as `parse_toml_text_as`.
[[nodiscard]] inline toml::table parse_toml(const std::filesystem::path& file,
                                            const std::string& format,
                                            int newest_version = 1) {
  return parse_toml_text_as(read_text_file(file), file, format, newest_version);
}

}  // namespace frangia
