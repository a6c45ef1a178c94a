#pragma once

#include <filesystem>

#include "frangia/core/durability.h"

namespace frangia {

/// Creates a folder and its missing parents. With Durability::Synced, the entries of the folder and
/// of each new parent are on the disk when the function returns.
///
/// @errors   Error(File) that names the folder
void make_folder(const std::filesystem::path& folder, Durability durability = Durability::Buffered);

}  // namespace frangia
