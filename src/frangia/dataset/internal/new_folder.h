#pragma once

#include <filesystem>

namespace frangia {

/// A folder that appears under its final name only when it is complete. It is made under a
/// hidden name in the same parent folder and renamed by `commit`; the destructor removes a folder
/// that was not committed.
///
/// @errors   Error(File) when the final name exists and is not an empty folder, or when the folder
///           cannot be made
class NewFolder {
 public:
  explicit NewFolder(std::filesystem::path path);
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  NewFolder(NewFolder&&) = delete;
  NewFolder& operator=(NewFolder&&) = delete;
  ~NewFolder();

  /// The folder while it is being filled.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Renames the folder to its final name.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
};

}  // namespace frangia
