#pragma once

#include <filesystem>

namespace frangia {

/// Waits until a file, or the entries of a folder, are on the disk (fsync).
///
/// @errors   Error(File) that names the path, for example when the disk is full or failing
void sync_to_disk(const std::filesystem::path& path);

/// Returns the folder of a file, or "." for a bare name.
[[nodiscard]] inline std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace frangia
