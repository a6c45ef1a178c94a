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

/// Unpacks the entries of an archive that lie in the folder of its only file `marker`, such as
/// "scan.toml", into a new folder, with their subfolders, which may hold others of that name.
/// Hidden entries are left out.
///
/// @errors   Error(Input) that names the archive: it is none, is damaged, has no or several folders
///          with a file `marker`, or an entry whose name leads out of the folder; what is unpacked
///          is larger than 64 MiB and than 200 times the archive; Error(File) when the folder
///          cannot be written; Error(Cancelled)
void unzip_folder(const std::filesystem::path& archive,
                  const std::string& marker,
                  const std::filesystem::path& folder,
                  const Run& run = {});

}  // namespace frangia
