#pragma once

#include <filesystem>

namespace frangia {

/// Makes a folder, and those above it.
///
/// errors   Error(File) that names it
void make_folder(const std::filesystem::path& folder);

}  // namespace frangia
