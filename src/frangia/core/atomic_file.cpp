#include "frangia/core/atomic_file.h"

#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "frangia/core/error.h"
#include "frangia/core/sync_to_disk.h"

namespace frangia {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ErrorKind::File, fmt::format("{}: cannot be written: {}", path.string(), why));
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path, Durability durability)
    : path_(std::move(path)), durability_(durability) {
  const auto folder = folder_of(path_);
  if (!std::filesystem::is_directory(folder)) {
    fail(path_, fmt::format("the folder {} does not exist; create it first", folder.string()));
  }
  if (std::filesystem::is_directory(path_)) fail(path_, "it is a folder; name a file");
  temporary_ = folder / fmt::format(".{}.{}.tmp", path_.filename().string(), ::getpid());
  stream_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!stream_)
    fail(path_, "the folder is not writable; choose another folder or change its permissions");
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
  if (durability_ == Durability::Synced) sync_to_disk(temporary_);
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) fail(path_, error.message());
  temporary_.clear();
  if (durability_ == Durability::Synced) sync_to_disk(folder_of(path_));
}

}  // namespace frangia
