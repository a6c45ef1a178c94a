#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// The whole of a file, as it is on the disk.
///
/// errors   Error(Input) that names the file: missing, a folder, not readable
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

}  // namespace frangia
