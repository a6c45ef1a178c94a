#pragma once

#include <filesystem>
#include <string_view>

namespace frangia {

/// Refuses a JSON text whose arrays and objects are nested more than 100 deep: parsers and the
/// destructors of their values recurse.
///
/// @errors   Error(Input) that names `file` and the line
void check_json_nesting(std::string_view text, const std::filesystem::path& file);

/// Refuses a TOML text whose arrays and inline tables are nested more than 100 deep, or that has a
/// key of more than 100 dotted parts.
///
/// @errors   Error(Input) that names `file` and the line
void check_toml_nesting(std::string_view text, const std::filesystem::path& file);

}  // namespace frangia
