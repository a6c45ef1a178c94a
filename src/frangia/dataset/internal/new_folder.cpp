#include "frangia/dataset/internal/new_folder.h"

#include <cstdint>
#include <random>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "frangia/core/error.h"
#include "frangia/core/make_folder.h"

namespace frangia {
namespace {

namespace fs = std::filesystem;

void require_free(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return;
  if (fs::is_directory(path, error) && fs::is_empty(path, error)) return;
  throw Error(ErrorKind::File,
              fmt::format("{}: exists already; remove it or choose another name", path.string()));
}

}  // namespace

NewFolder::NewFolder(fs::path path) : path_(std::move(path)) {
  // "scan/" names the folder "scan".
  if (!path_.has_filename()) path_ = path_.parent_path();
  require_free(path_);
  std::random_device random;
  const std::uint64_t number = (std::uint64_t{random()} << 32U) | random();
  temporary_ = path_.parent_path() /
               fmt::format(".{}.frangia-{:016x}.tmp", path_.filename().string(), number);
  make_folder(temporary_);
}

NewFolder::~NewFolder() {
  if (temporary_.empty()) return;
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void NewFolder::commit() {
  require_free(path_);
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) {
    throw Error(ErrorKind::File,
                fmt::format("{}: cannot be created: {}", path_.string(), error.message()));
  }
  temporary_.clear();
}

}  // namespace frangia
