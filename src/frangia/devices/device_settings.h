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

/// One value of a `[devices.*]` table. Whole numbers are numbers, too.
using SettingValue =
    std::variant<bool, double, std::string, std::vector<double>, std::vector<std::string>>;

/// One `[devices.NAME]` table of rig.toml. Each getter throws Error(Input) that names file and key;
/// those with `_or` have a value for a key that is not there.
class DeviceSettings {
 public:
  DeviceSettings(std::filesystem::path file,
                 std::string device,
                 std::map<std::string, SettingValue> values);

  /// "camera", "fringes", "line", "light", "turntable": what stands after `devices.`
  [[nodiscard]] const std::string& device() const { return device_; }
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// The key `driver`.
  [[nodiscard]] std::string driver() { return text("driver"); }

  [[nodiscard]] bool has(std::string_view key) const;
  [[nodiscard]] bool flag_or(std::string_view key, bool otherwise);
  [[nodiscard]] std::string text(std::string_view key);
  [[nodiscard]] std::string text_or(std::string_view key, std::string_view otherwise);
  /// One of `choices`; the first when the key is not there.
  [[nodiscard]] std::string choice(std::string_view key,
                                   std::initializer_list<std::string_view> choices);
  /// A path, relative ones from the rig file's folder.
  [[nodiscard]] std::filesystem::path path(std::string_view key);
  [[nodiscard]] double number(std::string_view key);
  [[nodiscard]] double number_or(std::string_view key, double otherwise);
  /// From `least` to `most`.
  [[nodiscard]] double number_or(std::string_view key, double otherwise, double least, double most);
  [[nodiscard]] int integer_or(std::string_view key, int otherwise, int least, int most);
  [[nodiscard]] std::vector<double> numbers(std::string_view key);
  [[nodiscard]] std::vector<double> numbers_or(std::string_view key,
                                               const std::vector<double>& otherwise);
  [[nodiscard]] std::vector<std::string> texts_or(std::string_view key,
                                                  const std::vector<std::string>& otherwise);

  /// "rig.toml: devices.camera.KEY WHAT"
  [[noreturn]] void fail(std::string_view key, std::string_view what) const;
  /// Warns of each key that no getter has asked for.
  void warn_of_unused_keys(const Run& run) const;

 private:
  [[nodiscard]] const SettingValue* find(std::string_view key);
  [[nodiscard]] const SettingValue& at(std::string_view key);

  std::filesystem::path file_;
  std::string device_;
  std::map<std::string, SettingValue> values_;
  std::set<std::string> used_;
};

/// The `[devices.*]` tables of a rig.toml, in the order of their names; empty when there are none.
///
/// errors   Error(Input) that names file and key: not a table, a value that is no setting
[[nodiscard]] std::vector<DeviceSettings> read_device_settings(const std::filesystem::path& rig);

}  // namespace frangia
