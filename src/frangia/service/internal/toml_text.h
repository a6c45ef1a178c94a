#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace frangia {

/// An object that arrived from a page as the text of a TOML file of a format, so that the one
/// reader of such files checks it. Keys whose value is null are left out.
[[nodiscard]] std::string toml_text(const nlohmann::json& object, std::string_view format);

}  // namespace frangia
