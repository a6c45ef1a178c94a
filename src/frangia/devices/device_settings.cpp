#include "frangia/devices/device_settings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "frangia/core/error.h"

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

}  // namespace frangia
