#include "frangia/service/internal/project_names.h"

#include <system_error>

#include <fmt/format.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"

namespace frangia {

std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& name) {
  std::error_code ignored;
  for (int i = 1;; ++i) {
    const auto path = folder / (i == 1 ? name : fmt::format("{} {}", name, i));
    if (!std::filesystem::exists(std::filesystem::symlink_status(path, ignored))) return path;
  }
}

void move_folder(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be moved: {}", from.string(), error.message()));
  }
  sync_to_disk(folder_of(to));
}

}  // namespace frangia
