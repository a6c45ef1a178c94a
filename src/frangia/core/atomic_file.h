#pragma once

#include <filesystem>
#include <fstream>

namespace frangia {

/// Whether a file must outlive a power cut from the moment it has its name.
enum class Durability {
  Buffered,  ///< the system writes it when it likes
  Synced     ///< it and its folder's entry are on the disk: tens of milliseconds
};

/// A file that appears under its name only when it is whole.
///
/// Bytes go to a temporary file in the same folder; `commit` flushes, checks and renames it. A file
/// that is not committed leaves nothing behind.
/// errors   Error(File) when the folder cannot be written or the disk is full
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path, Durability durability = Durability::Buffered);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  AtomicFile(AtomicFile&&) = delete;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// The temporary file's path, for a library that insists on opening it by name.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
  Durability durability_;
};

}  // namespace frangia
