#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// Reads a whole file of any size.
///
/// @errors   Error(Input) that names the file: it does not exist, is not a regular file, cannot be
///          read, or is packed or of a kind that no reader of meshes takes
[[nodiscard]] std::string read_bytes(const std::filesystem::path& path);

}  // namespace frangia
