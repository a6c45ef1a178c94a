#pragma once

#include <filesystem>
#include <string_view>

namespace frangia {

/// Refuses a JSON text nested more than 100 deep, since parsers and destructors recurse, and one of
/// more than a million values, which take up to 150 bytes each.
///
/// @errors   Error(Input) that names `file` and the line
void check_json_nesting(std::string_view text, const std::filesystem::path& file);

/// Refuses a TOML text whose arrays and inline tables are nested more than 100 deep, or that has a
/// key of more than 100 dotted parts.
///
/// @errors   Error(Input) that names `file` and the line
void check_toml_nesting(std::string_view text, const std::filesystem::path& file);

}  // namespace frangia
