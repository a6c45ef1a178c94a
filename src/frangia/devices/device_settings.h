#pragma once

#include <filesystem>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "frangia/core/run.h"

namespace frangia {

/// One value of a `[devices.NAME]` table. Integers are stored as numbers.
using SettingValue =
    std::variant<bool, double, std::string, std::vector<double>, std::vector<std::string>>;

/// One `[devices.NAME]` table of rig.toml.
///
/// @missing  getters with `_or` return a default for a missing key
/// @errors   each getter throws Error(Input) that names the file and the key
class DeviceSettings {
 public:
  /// `file` is the path of rig.toml, `device` the name of the table, `values` its keys and values.
  DeviceSettings(std::filesystem::path file,
                 std::string device,
                 std::map<std::string, SettingValue> values);

  /// "camera", "fringes", "line", "light", "turntable" or "camera-NAME": the name after `devices.`
  [[nodiscard]] const std::string& device() const { return device_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }  ///< path of rig.toml
  /// All keys of the table and their values.
  [[nodiscard]] const std::map<std::string, SettingValue>& values() const { return values_; }
  /// The value of the key `driver`.
  [[nodiscard]] std::string driver() { return text("driver"); }

  [[nodiscard]] bool has(std::string_view key) const;  ///< whether the table contains the key
  /// Boolean, or `otherwise` if the key is missing.
  [[nodiscard]] bool flag_or(std::string_view key, bool otherwise);
  [[nodiscard]] std::string text(std::string_view key);  ///< string; the key is required
  /// String, or `otherwise` if the key is missing.
  [[nodiscard]] std::string text_or(std::string_view key, std::string_view otherwise);
  /// A string, or a whole number of 0 or more as text: the name or the number of a device.
  [[nodiscard]] std::string name_or_number(std::string_view key, std::string_view otherwise);
  /// One of `choices`; the first when the key is missing.
  [[nodiscard]] std::string choice(std::string_view key,
                                   std::initializer_list<std::string_view> choices);
  /// A path; relative paths start at the folder of the rig file.
  [[nodiscard]] std::filesystem::path path(std::string_view key);
  [[nodiscard]] double number(std::string_view key);  ///< finite number; the key is required
  /// Finite number, or `otherwise`.
  [[nodiscard]] double number_or(std::string_view key, double otherwise);
  /// A number from `least` to `most`.
  [[nodiscard]] double number_or(std::string_view key, double otherwise, double least, double most);
  /// A whole number from `least` to `most`, or `otherwise` if the key is missing.
  [[nodiscard]] int integer_or(std::string_view key, int otherwise, int least, int most);
  /// List of numbers; the key is required.
  [[nodiscard]] std::vector<double> numbers(std::string_view key);
  /// List of numbers, or `otherwise` if the key is missing.
  [[nodiscard]] std::vector<double> numbers_or(std::string_view key,
                                               const std::vector<double>& otherwise);
  /// List of strings, or `otherwise` if the key is missing.
  [[nodiscard]] std::vector<std::string> texts_or(std::string_view key,
                                                  const std::vector<std::string>& otherwise);

  /// Throws Error(Input) with "rig.toml: devices.camera.KEY WHAT".
  [[noreturn]] void fail(std::string_view key, std::string_view what) const;
  /// Warns of each key that no getter has read.
  void warn_of_unused_keys(const Run& run) const;

 private:
  [[nodiscard]] const SettingValue* find(std::string_view key);
  [[nodiscard]] const SettingValue& at(std::string_view key);

  std::filesystem::path file_;
  std::string device_;
  std::map<std::string, SettingValue> values_;
  std::set<std::string> used_;
};

/// Reads the `[devices.NAME]` tables of a rig.toml, sorted by name; empty without any.
///
/// @errors   Error(Input) that names the file and the key: not a table, an unsupported type of
/// value
[[nodiscard]] std::vector<DeviceSettings> read_device_settings(const std::filesystem::path& rig);

}  // namespace frangia
