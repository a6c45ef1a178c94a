#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace frangia {

/// Bytes as letters, four for each three.
///
/// source   RFC 4648
[[nodiscard]] std::string encode_base64(std::string_view bytes);

/// The bytes of letters; nothing when they are not base64.
[[nodiscard]] std::optional<std::string> decode_base64(std::string_view letters);

}  // namespace frangia
