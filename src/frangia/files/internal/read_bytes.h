#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// Reads a whole file.
///
/// @errors   Error(Input) that names the file: it does not exist, is a folder, or cannot be read
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

}  // namespace frangia
