#include "frangia/core/folder_lock.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "frangia/core/durable_file.h"
#include "frangia/core/error.h"

namespace frangia {
namespace {

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "this machine";
}

/// Whether the open file is still the one at `path`: the process that had locked it may have
/// removed it in the meantime.
bool is_at(int file, const std::filesystem::path& path) {
  struct ::stat opened {};
  struct ::stat named {};
  return ::fstat(file, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

/// Whether an open file has no further name: who made the folder may have named a file of somebody
/// else so.
bool has_one_name(int file) {
  struct ::stat opened {};
  return ::fstat(file, &opened) == 0 && opened.st_nlink <= 1;
}

/// What the owner wrote into the lock file. It locks first: its line may be a moment late.
std::string owner_of(const std::filesystem::path& file) {
  std::string owner;
  for (int attempt = 0; attempt < 50; ++attempt) {
    std::ifstream in(file);
    if (std::getline(in, owner) && !in.eof()) return owner;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return "another process";
}

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::filesystem::path& file) {
  throw Error(ErrorKind::Input,
              fmt::format("{}: {} is writing to this folder; wait until it ends, or stop it",
                          folder.string(),
                          owner_of(file)));
}

/// Opens and locks the file at `path`.
int lock(const std::filesystem::path& folder, const std::filesystem::path& path) {
  for (;;) {
    const int file = ::open(path.c_str(),  // NOLINT(*-vararg)
                            O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK,
                            0644);
    const int result = file < 0 ? -1 : ::flock(file, LOCK_EX | LOCK_NB);
    if (result == 0 && is_at(file, path)) {
      if (has_one_name(file)) return file;
      ::close(file);
      throw Error(ErrorKind::Input,
                  fmt::format("{}: has another name (a hard link), under which it would change; "
                              "remove it",
                              path.string()));
    }
    const int error = errno;
    if (file >= 0) ::close(file);
    if (result == 0 || error == EINTR) continue;
    if (file >= 0 && error == EWOULDBLOCK) refuse(folder, path);
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be locked ({}); choose a folder on a local disk that you "
                            "may write to",
                            folder.string(),
                            std::generic_category().message(error)));
  }
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder)
    : folder_(std::filesystem::weakly_canonical(std::filesystem::absolute(folder))) {
  if (folder_.filename().empty() && folder_.has_relative_path()) folder_ = folder_.parent_path();
  path_ = folder_ / kFileName;
  std::error_code ignored;
  existing_ = folder_;
  while (existing_.has_relative_path() && !std::filesystem::exists(existing_, ignored))
    existing_ = existing_.parent_path();
  make_folder(folder_, Durability::Synced);
  file_ = lock(folder_, path_);
  const std::string owner = fmt::format("process {} on {}\n", ::getpid(), host_name());
  // Only a message needs the content: a full disk must not prevent the lock.
  static_cast<void>(::ftruncate(file_, 0) == 0);
  static_cast<void>(::write(file_, owner.data(), owner.size()) > 0);
}

FolderLock::~FolderLock() {
  ::unlink(path_.c_str());  // before the lock is released, so that nobody locks a removed file
  ::close(file_);
  for (auto created = folder_; created != existing_; created = created.parent_path())
    if (::rmdir(created.c_str()) != 0) break;
}

}  // namespace frangia
