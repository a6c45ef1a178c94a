#include "frangia/core/durable_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/core/file_descriptor.h"

namespace frangia {
namespace {

constexpr std::string_view kMark = ".frangia-";
constexpr std::string_view kEnding = ".tmp";
constexpr std::size_t kRandomDigits = 16;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::File, fmt::format("{}: cannot be written: {}", path.string(), why));
}

std::string cause_of(int error) {
  if (error == EACCES || error == EPERM || error == EROFS)
    return "the folder is not writable; choose another folder or change its permissions";
  if (error == ENOSPC || error == EDQUOT) return "the disk is full; free some space";
  return std::generic_category().message(error);
}

/// The state of the file that is replaced; empty for a new file.
bool find_existing(const std::filesystem::path& path, struct ::stat& state) {
  if (::stat(path.c_str(), &state) != 0) return false;
  if (S_ISDIR(state.st_mode)) fail(path, "it is a folder; name a file");
  if (!S_ISREG(state.st_mode)) fail(path, "it is a device or a named pipe; name a file");
  return true;
}

/// Creates an empty file with a name that no other process can have chosen.
std::filesystem::path create_temporary(const std::filesystem::path& path, bool is_private) {
  constexpr std::size_t kNameLength = 200;  // of at most 255 bytes, the limit of file systems
  constexpr int kAttempts = 10;
  const std::string name = path.filename().string().substr(0, kNameLength);
  std::random_device random;
  for (int attempt = 1;; ++attempt) {
    const std::uint64_t number = (std::uint64_t{random()} << 32U) | random();
    std::filesystem::path temporary =
        folder_of(path) / fmt::format(".{}{}{:016x}{}", name, kMark, number, kEnding);
    const int file = ::open(temporary.c_str(),  // NOLINT(*-vararg)
                            O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                            is_private ? 0600 : 0666);
    if (file >= 0) {
      ::close(file);
      return temporary;
    }
    if (errno != EEXIST || attempt == kAttempts) fail(path, cause_of(errno));
  }
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path, Durability durability)
    : path_(std::move(path)), durability_(durability) {
  const auto folder = folder_of(path_);
  if (!std::filesystem::is_directory(folder)) {
    fail(path_, fmt::format("the folder {} does not exist; create it first", folder.string()));
  }
  struct ::stat existing {};
  // Nobody else reads the new content before it has the permissions of the old file.
  temporary_ = create_temporary(path_, find_existing(path_, existing));
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_) {
    const std::string cause = cause_of(errno);
    ::unlink(temporary_.c_str());
    fail(path_, cause);
  }
}

AtomicFile::~AtomicFile() {
  if (temporary_.empty()) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  stream_.close();
  if (!stream_) fail(path_, "the disk is full or failing; free some space");
  struct ::stat existing {};
  if (find_existing(path_, existing)) {
    // Only root may give a file away; other users become the owner of what they replace.
    static_cast<void>(!::chown(temporary_.c_str(), existing.st_uid, existing.st_gid));
    if (::chmod(temporary_.c_str(), existing.st_mode & 0777U) != 0) fail(path_, cause_of(errno));
  }
  if (durability_ == Durability::Synced) sync_to_disk(temporary_);
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) fail(path_, error.message());
  temporary_.clear();
  if (durability_ == Durability::Synced) sync_to_disk(folder_of(path_));
}

bool is_temporary_file_name(const std::string& name) {
  const std::size_t fixed = kMark.size() + kRandomDigits + kEnding.size();
  if (name.size() < fixed + 2 || name.front() != '.' || !name.ends_with(kEnding)) return false;
  const std::string_view tail = std::string_view(name).substr(name.size() - fixed);
  const std::string_view digits = tail.substr(kMark.size(), kRandomDigits);
  return tail.starts_with(kMark) && std::all_of(digits.begin(), digits.end(), [](char digit) {
           return (digit >= '0' && digit <= '9') || (digit >= 'a' && digit <= 'f');
         });
}

std::size_t remove_temporary_files(const std::filesystem::path& folder) {
  std::size_t count = 0;
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator entry(folder, error), end;
       !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;  // a file that cannot be removed does not end the search
    const bool is_file =
        entry->symlink_status(ignored).type() == std::filesystem::file_type::regular;
    if (is_file && is_temporary_file_name(entry->path().filename().string()))
      count += std::filesystem::remove(entry->path(), ignored) ? 1U : 0U;
  }
  return count;
}

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

void write_text_file(const std::filesystem::path& path,
                     std::string_view text,
                     Durability durability) {
  AtomicFile file(path, durability);
  file.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  file.commit();
}

}  // namespace frangia
