#include "frangia/devices/device_settings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"
#include "frangia/devices/device_table.h"
#include "frangia/rig/toml_reader.h"
#include "frangia/rig/toml_writer.h"

namespace frangia {

DeviceSettings::DeviceSettings(std::filesystem::path file,
                               std::string device,
                               std::map<std::string, SettingValue> values)
    : file_(std::move(file)), device_(std::move(device)), values_(std::move(values)) {}

void DeviceSettings::fail(std::string_view key, std::string_view what) const {
  throw Error(ErrorKind::Input,
              fmt::format("{}: devices.{}.{} {}", file_.string(), device_, key, what));
}

const SettingValue* DeviceSettings::find(std::string_view key) {
  const auto found = values_.find(std::string(key));
  if (found == values_.end()) return nullptr;
  used_.insert(std::string(key));
  return &found->second;
}

const SettingValue& DeviceSettings::at(std::string_view key) {
  const SettingValue* value = find(key);
  if (value == nullptr) fail(key, "is missing");
  return *value;
}

bool DeviceSettings::has(std::string_view key) const {
  return values_.contains(std::string(key));
}

bool DeviceSettings::flag_or(std::string_view key, bool otherwise) {
  if (!has(key)) return otherwise;
  const bool* flag = std::get_if<bool>(&at(key));
  if (flag == nullptr) fail(key, "must be true or false");
  return *flag;
}

std::string DeviceSettings::text(std::string_view key) {
  const std::string* value = std::get_if<std::string>(&at(key));
  if (value == nullptr) fail(key, "must be a string in quotes");
  return *value;
}

std::string DeviceSettings::text_or(std::string_view key, std::string_view otherwise) {
  return has(key) ? text(key) : std::string(otherwise);
}

std::string DeviceSettings::name_or_number(std::string_view key, std::string_view otherwise) {
  if (!has(key)) return std::string(otherwise);
  const SettingValue& value = at(key);
  if (const auto* name = std::get_if<std::string>(&value)) return *name;
  const double* number = std::get_if<double>(&value);
  if (number == nullptr || !(*number >= 0.0 && *number <= 1e6) || *number != std::floor(*number))
    fail(key, "must be a name in quotes or a whole number from 0");
  return fmt::format("{:.0f}", *number);
}

std::string DeviceSettings::choice(std::string_view key,
                                   std::initializer_list<std::string_view> choices) {
  std::string value = text_or(key, *choices.begin());
  if (std::find(choices.begin(), choices.end(), value) == choices.end())
    fail(key, fmt::format("is \"{}\"; it must be one of {}", value, fmt::join(choices, ", ")));
  return value;
}

std::filesystem::path DeviceSettings::path(std::string_view key) {
  return file_.parent_path() / text(key);
}

double DeviceSettings::number(std::string_view key) {
  const double* value = std::get_if<double>(&at(key));
  if (value == nullptr || !std::isfinite(*value)) fail(key, "must be a finite number");
  return *value;
}

double DeviceSettings::number_or(std::string_view key, double otherwise) {
  return has(key) ? number(key) : otherwise;
}

double DeviceSettings::number_or(std::string_view key,
                                 double otherwise,
                                 double least,
                                 double most) {
  const double value = number_or(key, otherwise);
  if (value < least || value > most)
    fail(key, fmt::format("is {:g}; it must lie between {:g} and {:g}", value, least, most));
  return value;
}

int DeviceSettings::integer_or(std::string_view key, int otherwise, int least, int most) {
  const double value = number_or(key, otherwise, least, most);
  if (value != std::floor(value)) fail(key, "must be a whole number");
  return static_cast<int>(value);
}

std::vector<double> DeviceSettings::numbers(std::string_view key) {
  const auto* values = std::get_if<std::vector<double>>(&at(key));
  if (values == nullptr) fail(key, "must be a list of numbers");
  return *values;
}

std::vector<double> DeviceSettings::numbers_or(std::string_view key,
                                               const std::vector<double>& otherwise) {
  return has(key) ? numbers(key) : otherwise;
}

std::vector<std::string> DeviceSettings::texts_or(std::string_view key,
                                                  const std::vector<std::string>& otherwise) {
  if (!has(key)) return otherwise;
  const auto* values = std::get_if<std::vector<std::string>>(&at(key));
  if (values == nullptr) fail(key, "must be a list of strings in quotes");
  return *values;
}

void DeviceSettings::warn_of_unused_keys(const Run& run) const {
  for (const auto& value : values_) {
    if (used_.contains(value.first)) continue;
    run.warn(fmt::format(
        "{}: devices.{}.{} is unknown and ignored", file_.string(), device_, value.first));
  }
}

namespace {

using Settings = std::map<std::string, SettingValue>;

std::optional<SettingValue> list_of(const toml::array& list) {
  std::vector<double> numbers;
  std::vector<std::string> texts;
  for (const toml::node& item : list) {
    if (const auto text = item.value_exact<std::string>()) texts.push_back(*text);
    if (item.is_number()) numbers.push_back(item.value<double>().value());
  }
  if (!texts.empty() && texts.size() == list.size()) return texts;
  if (numbers.size() == list.size()) return numbers;
  return std::nullopt;
}

std::optional<SettingValue> value_of(const toml::node& node) {
  if (const auto flag = node.value_exact<bool>()) return *flag;
  if (node.is_number()) return node.value<double>().value();
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const toml::array* list = node.as_array()) return list_of(*list);
  return std::nullopt;
}

DeviceSettings settings_of(const toml::table& entries,
                           const std::filesystem::path& file,
                           const std::string& device,
                           const TomlReader& reader) {
  Settings values;
  for (const auto& [key, value] : entries) {
    auto setting = value_of(value);
    const std::string place = fmt::format("devices.{}.{}", device, std::string(key.str()));
    if (!setting)
      reader.fail(place, "must be a number, a string, true or false, or a list of those");
    values.emplace(std::string(key.str()), std::move(*setting));
  }
  return {file, device, std::move(values)};
}

bool is_bare_key(const std::string& key) {
  constexpr std::string_view kBare =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return !key.empty() && key.find_first_not_of(kBare) == std::string::npos;
}

void put_setting(TomlWriter& writer, const std::string& key, const SettingValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return writer.put(key, *flag);
  if (const auto* text = std::get_if<std::string>(&value)) return writer.put(key, *text);
  if (const auto* list = std::get_if<std::vector<double>>(&value)) return writer.put(key, *list);
  if (const auto* number = std::get_if<double>(&value)) {
    const auto whole = static_cast<std::int64_t>(*number);
    if (std::abs(*number) < 1e15 && static_cast<double>(whole) == *number)
      return writer.put(key, whole);
    return writer.put(key, *number);
  }
  writer.put(key, std::get<std::vector<std::string>>(value));
}

}  // namespace

DeviceSettings parse_device_table(const std::string& lines,
                                  const std::filesystem::path& file,
                                  const std::string& device) {
  const toml::table table = parse_toml_text(lines, file);
  const TomlReader reader(file, "", table);
  for (const auto& [key, value] : table) {
    if (!is_bare_key(std::string(key.str())))
      reader.fail(fmt::format("devices.{}", device), "has a key that is not a plain word");
  }
  return settings_of(table, file, device, reader);
}

std::string device_table_lines(const DeviceSettings& settings) {
  TomlWriter writer;
  const auto& values = settings.values();
  if (const auto driver = values.find("driver"); driver != values.end())
    put_setting(writer, driver->first, driver->second);
  for (const auto& [key, value] : values)
    if (key != "driver") put_setting(writer, key, value);
  return writer.text();
}

std::vector<DeviceSettings> read_device_settings(const std::filesystem::path& rig) {
  const toml::table table = parse_toml(rig, "frangia-rig");
  std::vector<DeviceSettings> all;
  if (!table.contains("devices")) return all;
  const TomlReader reader(rig, "", table);
  const toml::table* devices = table["devices"].as_table();
  if (devices == nullptr) reader.fail("devices", "must hold tables, such as [devices.camera]");
  for (const auto& [device, node] : *devices) {
    const std::string name(device.str());
    const toml::table* entries = node.as_table();
    if (entries == nullptr)
      reader.fail("devices." + name, "must be a table, [devices." + name + "]");
    all.push_back(settings_of(*entries, rig, name, reader));
  }
  return all;
}

}  // namespace frangia
