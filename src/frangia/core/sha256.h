#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace frangia {

/// Returns the SHA-256 of bytes as 64 hexadecimal digits.
///
/// @source   FIPS 180-4
[[nodiscard]] std::string sha256(std::string_view bytes);

/// Returns the SHA-256 of the contents of a file.
///
/// @errors   Error(Input) that names the file when it cannot be read
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace frangia
