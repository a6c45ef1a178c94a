#pragma once

#include <filesystem>
#include <fstream>

namespace frangia {

/// How strongly a committed file is protected against a power failure.
enum class Durability {
  Buffered,  ///< the operating system chooses when to write to the disk
  Synced     ///< the file and its folder entry are on the disk when `commit` returns; takes tens of
             ///< milliseconds
};

/// A file that appears under its final name only when it is complete.
///
/// Bytes go to a temporary file in the same folder. `commit` flushes, checks and renames it. The
/// destructor removes a temporary file that was not committed.
///
/// @errors   Error(File) when the folder cannot be written or the disk is full
class AtomicFile {
 public:
  /// Opens the temporary file beside `path`; with Durability::Synced, `commit` waits for the disk.
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

}  // namespace frangia
