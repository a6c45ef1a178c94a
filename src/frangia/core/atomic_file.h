#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

#include "frangia/core/durability.h"

namespace frangia {

/// A file that appears under its final name only when it is complete.
///
/// Bytes go to a new temporary file with a random name in the same folder. `commit` flushes, checks
/// and renames it. A file that it replaces keeps its permissions. The destructor removes a
/// temporary file that was not committed.
///
/// @errors   Error(File) when the folder cannot be written, the disk is full, or the path names a
///          folder, a device or a named pipe
class AtomicFile {
 public:
  /// Opens the temporary file in the folder of `path`. With Durability::Synced, `commit` waits for
  /// the disk.
  explicit AtomicFile(std::filesystem::path path, Durability durability = Durability::Buffered);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  AtomicFile(AtomicFile&&) = delete;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  [[nodiscard]] std::ostream& stream() { return stream_; }  ///< stream to write the content to
  /// Path of the temporary file, for libraries that open files by name.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Closes the temporary file, checks that all bytes were written and renames it to the final
  /// path.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  Durability durability_;
};

/// Whether a file name has the form of AtomicFile's temporary files:
/// ".NAME.frangia-0123456789abcdef.tmp".
[[nodiscard]] bool is_temporary_file_name(const std::string& name);

/// Removes the temporary files that killed processes left in a folder and its subfolders. No other
/// process may be writing there. Does not follow symbolic links. Returns the number of files.
std::size_t remove_temporary_files(const std::filesystem::path& folder);

}  // namespace frangia
