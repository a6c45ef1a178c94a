#include "frangia/core/make_folder.h"

#include <system_error>

#include <fmt/format.h>

#include "frangia/core/error.h"

namespace frangia {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be created: {}", folder.string(), error.message()));
  }
}

}  // namespace frangia
