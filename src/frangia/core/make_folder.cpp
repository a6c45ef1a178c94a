#include "frangia/core/make_folder.h"

#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/sync_to_disk.h"

namespace frangia {

void make_folder(const std::filesystem::path& folder, Durability durability) {
  std::error_code error;
  std::vector<std::filesystem::path> parents;  // of the folders that are missing
  for (std::filesystem::path missing = folder;
       !missing.empty() && !std::filesystem::exists(missing, error);
       missing = folder_of(missing))
    parents.push_back(folder_of(missing));
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  }
  if (durability != Durability::Synced) return;
  // A killed process may have created the folder without syncing it.
  if (parents.empty()) parents.push_back(folder_of(folder));
  for (const std::filesystem::path& parent : parents)
    sync_to_disk(parent);
}

}  // namespace frangia
