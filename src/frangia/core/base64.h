#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace frangia {

/// Encodes bytes as base64.
///
/// @source   RFC 4648, section 4
[[nodiscard]] std::string encode_base64(std::string_view bytes);

/// Decodes base64, with or without the padding at its end.
///
/// @missing  nullopt: a character is not base64
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view letters);

}  // namespace frangia
