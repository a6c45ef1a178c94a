#pragma once

#include <filesystem>

namespace frangia {

/// The right of one process to write to a folder, from construction to destruction.
///
/// The lock is that of the operating system (flock) on the file `.frangia-lock` in the folder,
/// which states the process for messages and disappears with the lock. The system releases the lock
/// of a process that ends, however it ends. The lock excludes other writers only; anyone may read.
class FolderLock {
 public:
  /// Name of the lock file.
  static constexpr const char* kFileName = ".frangia-lock";

  /// Locks a folder, which is created if it is missing. The destructor removes a folder that it
  /// created and that is still empty.
  ///
  /// @errors   Error(Input) that names the folder and the process that has locked it; Error(File)
  ///          when the folder cannot be created or does not support locks
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  FolderLock(FolderLock&&) = delete;
  FolderLock& operator=(FolderLock&&) = delete;
  ~FolderLock();

  /// The locked folder, as an absolute path.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// The open lock file. A process that inherits it holds the lock, too, until it ends.
  [[nodiscard]] int descriptor() const { return file_; }
  /// Path of the lock file.
  [[nodiscard]] const std::filesystem::path& file() const { return path_; }

 private:
  std::filesystem::path folder_;
  std::filesystem::path path_;
  std::filesystem::path existing_;  ///< the nearest folder that existed before
  int file_ = -1;
};

}  // namespace frangia
