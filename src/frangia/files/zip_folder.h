#pragma once

#include <filesystem>
#include <string>

#include "frangia/core/run.h"

namespace frangia {

/// Writes all regular files of a folder and its subfolders into a zip archive, sorted by name,
/// under the folder `name`. Links, hidden files and temporary files are left out.
///
/// @errors   Error(Input) for a folder without files; Error(File) when a file cannot be read or the
///          archive cannot be written; Error(Cancelled)
void zip_folder(const std::filesystem::path& folder,
                const std::string& name,
                const std::filesystem::path& archive,
                const Run& run = {});

}  // namespace frangia
