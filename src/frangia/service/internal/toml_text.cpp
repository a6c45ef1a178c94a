#include "frangia/service/internal/toml_text.h"

#include <fmt/format.h>

namespace frangia {
namespace {

/// A value of JSON as TOML writes it.
std::string toml_of(const nlohmann::json& value) {
  if (value.is_object()) {
    std::string inner;
    for (const auto& [key, one] : value.items()) {
      if (one.is_null()) continue;
      inner += (inner.empty() ? "" : ", ") + nlohmann::json(key).dump() + " = " + toml_of(one);
    }
    return "{" + inner + "}";
  }
  if (value.is_array()) {
    std::string inner;
    for (const nlohmann::json& one : value)
      inner += (inner.empty() ? "" : ", ") + toml_of(one);
    return "[" + inner + "]";
  }
  return value.dump();
}

}  // namespace

std::string toml_text(const nlohmann::json& object, std::string_view format) {
  std::string text = fmt::format("format = \"{}\"\nversion = 1\n", format);
  for (const auto& [key, value] : object.items()) {
    if (key == "format" || key == "version" || value.is_null()) continue;
    text += nlohmann::json(key).dump() + " = " + toml_of(value) + "\n";
  }
  return text;
}

}  // namespace frangia
