#pragma once

#include <filesystem>

namespace frangia {

/// Waits until a file, or a folder's list of names, is on the disk (fsync).
///
/// errors   Error(File) that names it, such as when the disk is full or failing
void sync_to_disk(const std::filesystem::path& path);

/// Where a file lies: its folder, or "." for a bare name.
[[nodiscard]] inline std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace frangia
