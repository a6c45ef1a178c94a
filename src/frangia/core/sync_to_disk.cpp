#include "frangia/core/sync_to_disk.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "frangia/core/error.h"

namespace frangia {

void sync_to_disk(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);  // NOLINT(*-vararg)
  const bool synced = file >= 0 && ::fsync(file) == 0;
  const int error = errno;
  if (file >= 0) ::close(file);
  if (synced) return;
  throw Error(
      ErrorKind::File,
      fmt::format("{}: cannot be written to the disk ({}); free some space or check the disk",
                  path.string(),
                  std::generic_category().message(error)));
}

}  // namespace frangia
