#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// Reads a whole file of any size.
///
/// @errors   Error(Input) that names the file: it does not exist, is not a regular file, or cannot
///          be read
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

}  // namespace frangia
