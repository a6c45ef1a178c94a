#pragma once

#include <filesystem>

namespace frangia {

/// Creates a folder and its missing parents.
///
/// @errors   Error(File) that names the folder
void make_folder(const std::filesystem::path& folder);

}  // namespace frangia
