#include <optional>
#include <utility>

#include <fmt/format.h>

#include "frangia/devices/device_settings.h"
#include "frangia/rig/toml_reader.h"

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

}  // namespace

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
    Settings values;
    for (const auto& [key, value] : *entries) {
      auto setting = value_of(value);
      const std::string place = fmt::format("devices.{}.{}", name, std::string(key.str()));
      if (!setting)
        reader.fail(place, "must be a number, a string, true or false, or a list of those");
      values.emplace(std::string(key.str()), std::move(*setting));
    }
    all.emplace_back(rig, name, std::move(values));
  }
  return all;
}

}  // namespace frangia
