#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace frangia {

/// How strongly a written file or folder is protected against a power failure.
enum class Durability {
  Buffered,  ///< the operating system chooses when to write to the disk
  Synced     ///< the content and its folder entry are on the disk when the call returns; takes tens
             ///< of milliseconds
};

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

/// Waits until a file, or the entries of a folder, are on the disk (fsync).
///
/// @errors   Error(File) that names the path, for example when the disk is full or failing
void sync_to_disk(const std::filesystem::path& path);

/// Returns the folder of a file, or "." for a bare name.
[[nodiscard]] inline std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// Creates a folder and its missing parents. With Durability::Synced, the entries of the folder and
/// of each new parent are on the disk when the function returns.
///
/// @errors   Error(File) that names the folder
void make_folder(const std::filesystem::path& folder, Durability durability = Durability::Buffered);

/// Writes a file that its owner alone may read and write: mode 0600 from its creation on, whatever
/// it replaces. It appears complete, as AtomicFile; for a moment, a new one is empty.
///
/// @errors   Error(File) as AtomicFile
void write_private_file(const std::filesystem::path& path,
                        std::string_view text,
                        Durability durability = Durability::Buffered);

/// Replaces a file in one step: a reader sees either all of the old bytes or all of the new ones.
/// `text` may hold any bytes.
///
/// @errors   Error(File) when it cannot be written, see AtomicFile
void write_text_file(const std::filesystem::path& path,
                     std::string_view text,
                     Durability durability = Durability::Buffered);

}  // namespace frangia
