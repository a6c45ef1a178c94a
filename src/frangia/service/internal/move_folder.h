#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// The first of "Bust", "Bust 2", ... that a folder does not hold.
[[nodiscard]] std::filesystem::path free_name(const std::filesystem::path& folder,
                                              const std::string& name);

/// Renames a folder, and waits until the disk has its new name.
///
/// @errors   Error(File) that names the folder
void move_folder(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace frangia
