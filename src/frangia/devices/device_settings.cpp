#include "frangia/devices/device_settings.h"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/rig/toml_reader.h"

namespace frangia {
namespace {

/// A list of numbers or of texts; nothing when it is neither.
std::optional<SettingValue> list_of(const toml::array& list) {
  std::vector<double> numbers;
  std::vector<std::string> texts;
  for (const auto& item : list) {
    if (const auto text = item.value_exact<std::string>()) {
      texts.push_back(*text);
    } else if (const auto number = item.value<double>(); number && !item.is_boolean()) {
      numbers.push_back(*number);
    } else {
      return std::nullopt;
    }
  }
  if (!texts.empty() && !numbers.empty()) return std::nullopt;
  if (!texts.empty()) return texts;
  return numbers;
}

std::optional<SettingValue> value_of(const toml::node& node) {
  if (const auto flag = node.value_exact<bool>()) return *flag;
  if (const auto whole = node.value_exact<std::int64_t>()) return *whole;
  if (const auto number = node.value_exact<double>()) return *number;
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const toml::array* list = node.as_array()) return list_of(*list);
  return std::nullopt;
}

}  // namespace

DeviceSettings::DeviceSettings(std::filesystem::path file,
                               std::string role,
                               std::map<std::string, SettingValue> values)
    : file_(std::move(file)), role_(std::move(role)), values_(std::move(values)) {
  driver_ = text("driver");
}

std::string DeviceSettings::device_name() const {
  return fmt::format("{} ({})", role_, driver_);
}

const SettingValue* DeviceSettings::find(std::string_view key) const {
  const auto found = values_.find(std::string(key));
  if (found == values_.end()) return nullptr;
  used_.insert(found->first);
  return &found->second;
}

void DeviceSettings::fail(std::string_view key, const std::string& what) const {
  throw Error(ErrorKind::Input,
              fmt::format("{}: devices.{}.{} {}", file_.string(), role_, key, what));
}

bool DeviceSettings::has(std::string_view key) const {
  return values_.contains(std::string(key));
}

std::string DeviceSettings::text(std::string_view key) const {
  const SettingValue* value = find(key);
  if (value == nullptr) fail(key, "is missing");
  const auto* text = std::get_if<std::string>(value);
  if (text == nullptr) fail(key, "must be a text in quotes");
  return *text;
}

std::string DeviceSettings::text_or(std::string_view key, const std::string& otherwise) const {
  return has(key) ? text(key) : otherwise;
}

double DeviceSettings::number(std::string_view key) const {
  const SettingValue* value = find(key);
  if (value == nullptr) fail(key, "is missing");
  if (const auto* whole = std::get_if<std::int64_t>(value)) return static_cast<double>(*whole);
  const auto* number = std::get_if<double>(value);
  if (number == nullptr || !std::isfinite(*number)) fail(key, "must be a finite number");
  return *number;
}

double DeviceSettings::number_or(std::string_view key, double otherwise) const {
  return has(key) ? number(key) : otherwise;
}

double DeviceSettings::number_in(std::string_view key,
                                 double otherwise,
                                 double low,
                                 double high) const {
  const double value = number_or(key, otherwise);
  if (value < low || value > high) {
    fail(key, fmt::format("is {}; it must lie between {} and {}", value, low, high));
  }
  return value;
}

std::int64_t DeviceSettings::integer_or(std::string_view key, std::int64_t otherwise) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return otherwise;
  const auto* whole = std::get_if<std::int64_t>(value);
  if (whole == nullptr) fail(key, "must be a whole number");
  return *whole;
}

bool DeviceSettings::flag_or(std::string_view key, bool otherwise) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return otherwise;
  const auto* flag = std::get_if<bool>(value);
  if (flag == nullptr) fail(key, "must be true or false");
  return *flag;
}

std::vector<double> DeviceSettings::numbers(std::string_view key) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return {};
  const auto* list = std::get_if<std::vector<double>>(value);
  if (list == nullptr) fail(key, "must be a list of numbers");
  return *list;
}

std::vector<std::string> DeviceSettings::texts(std::string_view key) const {
  const SettingValue* value = find(key);
  if (value == nullptr) return {};
  if (const auto* none = std::get_if<std::vector<double>>(value);
      none != nullptr && none->empty()) {
    return {};  // [] is a list of anything
  }
  const auto* list = std::get_if<std::vector<std::string>>(value);
  if (list == nullptr) fail(key, "must be a list of texts in quotes");
  return *list;
}

void DeviceSettings::warn_of_the_rest(const Run& run) const {
  for (const auto& [key, value] : values_) {
    if (used_.contains(key)) continue;
    run.warn(fmt::format(
        "{}: devices.{}.{} is not known to {} and ignored", file_.string(), role_, key, driver_));
  }
}

std::vector<DeviceSettings> read_device_settings(const std::filesystem::path& rig_toml) {
  const toml::table table = parse_toml(rig_toml, "frangia-rig");
  const auto fail = [&](std::string_view key, const char* what) {
    throw Error(ErrorKind::Input, fmt::format("{}: devices{} {}", rig_toml.string(), key, what));
  };
  std::vector<DeviceSettings> all;
  const toml::node* found = table.get("devices");
  if (found == nullptr) return all;
  const toml::table* devices = found->as_table();
  if (devices == nullptr) fail("", "must be tables, such as [devices.camera]");
  for (const auto& [role, node] : *devices) {
    const std::string place = fmt::format(".{}", role.str());
    const toml::table* device = node.as_table();
    if (device == nullptr) fail(place, "must be a table with a driver");
    std::map<std::string, SettingValue> values;
    for (const auto& [key, item] : *device) {
      const auto value = value_of(item);
      if (!value) {
        fail(fmt::format("{}.{}", place, key.str()),
             "must be a number, a text, true, false, or a list of numbers or of texts");
      }
      values.emplace(std::string(key.str()), *value);
    }
    all.emplace_back(rig_toml, std::string(role.str()), std::move(values));
  }
  return all;
}

}  // namespace frangia
