#include "frangia/core/write_private_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "frangia/core/atomic_file.h"
#include "frangia/core/file_descriptor.h"
#include "frangia/core/write_text_file.h"

namespace frangia {

void write_private_file(const std::filesystem::path& path,
                        std::string_view text,
                        Durability durability) {
  constexpr ::mode_t kOwnerOnly = 0600;
  constexpr int kNew = O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC;
  struct ::stat present {};
  if (::lstat(path.c_str(), &present) == 0 && S_ISLNK(present.st_mode)) ::unlink(path.c_str());
  const FileDescriptor fresh(::open(path.c_str(), kNew, kOwnerOnly));  // NOLINT(*-vararg)
  // AtomicFile writes a private temporary file where one exists, and keeps its permissions.
  if (!fresh.is_open()) static_cast<void>(::chmod(path.c_str(), kOwnerOnly));
  try {
    write_text_file(path, text, durability);
  } catch (...) {
    if (fresh.is_open()) ::unlink(path.c_str());
    throw;
  }
}

}  // namespace frangia
