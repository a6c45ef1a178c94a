#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "frangia/core/run.h"

namespace frangia {

using SettingValue = std::
    variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;

/// One [devices.ROLE] table of a rig.toml: the driver's name and its keys, each asked for by its
/// type. A key with a unit has it in its name: baud, port, steps_per_deg, delay_ms.
///
/// errors   all of them Error(Input) that name the file, the key and what it must be
class DeviceSettings {
 public:
  DeviceSettings(std::filesystem::path file,
                 std::string role,
                 std::map<std::string, SettingValue> values);

  [[nodiscard]] const std::string& role() const { return role_; }      ///< "camera", "turntable"
  [[nodiscard]] const std::string& driver() const { return driver_; }  ///< "simulated", "grbl"
  /// How errors name the device: "turntable (grbl)".
  [[nodiscard]] std::string device_name() const;

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] std::string text_or(std::string_view key, const std::string& otherwise) const;
  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] double number_or(std::string_view key, double otherwise) const;
  /// A number, or `otherwise`, that must lie in [low, high].
  [[nodiscard]] double number_in(std::string_view key,
                                 double otherwise,
                                 double low,
                                 double high) const;
  [[nodiscard]] std::int64_t integer_or(std::string_view key, std::int64_t otherwise) const;
  [[nodiscard]] bool flag_or(std::string_view key, bool otherwise) const;
  /// Lists; empty when the key is not there.
  [[nodiscard]] std::vector<double> numbers(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;

  [[noreturn]] void fail(std::string_view key, const std::string& what) const;
  /// Warns of each key that no one has asked for.
  void warn_of_the_rest(const Run& run) const;

 private:
  [[nodiscard]] const SettingValue* find(std::string_view key) const;

  std::filesystem::path file_;
  std::string role_;
  std::string driver_;
  std::map<std::string, SettingValue> values_;
  mutable std::set<std::string> used_;
};

/// All [devices.*] tables of a rig.toml, in the order of their roles' names.
///
/// errors   Error(Input) that names the file and the key: not a table, no driver, a value of a kind
///          that no setting has
[[nodiscard]] std::vector<DeviceSettings> read_device_settings(
    const std::filesystem::path& rig_toml);

}  // namespace frangia
