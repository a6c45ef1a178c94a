#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace frangia {

/// Returns the CRC-32 of zip and PNG: 0xCBF43926 for "123456789".
///
/// @source   ISO 3309, the reflected polynomial 0xEDB88320, by zlib
[[nodiscard]] std::uint32_t crc32(std::span<const char> bytes);

/// Returns the SHA-256 of bytes as 64 hexadecimal digits.
///
/// @source   FIPS 180-4
[[nodiscard]] std::string sha256(std::string_view bytes);

/// Returns the SHA-256 of the contents of a file.
///
/// @errors   Error(Input) that names the file when it cannot be read
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace frangia
