#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "frangia/devices/device_settings.h"
#include "frangia/devices/device_table.h"
#include "frangia/rig/toml_reader.h"
#include "frangia/rig/toml_writer.h"

namespace frangia {
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
