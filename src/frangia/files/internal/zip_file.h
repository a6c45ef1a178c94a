#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace frangia {

/// Reads a zip archive entry by entry.
///
/// @errors   Error(Input) that names the file: it does not exist, is not a zip archive or is
///          damaged; an entry expands to more than 8 GB, or to more than 64 MB and 200 times its
///          size
class ZipReader {
 public:
  explicit ZipReader(std::filesystem::path path);
  ZipReader(const ZipReader&) = delete;
  ZipReader& operator=(const ZipReader&) = delete;
  ZipReader(ZipReader&&) = delete;
  ZipReader& operator=(ZipReader&&) = delete;
  ~ZipReader();

  /// Passes an entry to `consume` in pieces, each with the share of the entry that it completes, 0
  /// to 1; false when no entry has this name (case-sensitive).
  bool read(const std::string& name,
            const std::function<void(std::string_view, double)>& consume) const;
  /// Names of all entries, in the order of the archive; those of folders end with a slash.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  struct Archive;
  std::filesystem::path path_;
  std::unique_ptr<Archive> archive_;
};

/// Writes a zip archive that appears under its name when it is complete.
///
/// @errors   Error(File) as AtomicFile
class ZipWriter {
 public:
  explicit ZipWriter(const std::filesystem::path& path);
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;
  ZipWriter(ZipWriter&&) = delete;
  ZipWriter& operator=(ZipWriter&&) = delete;
  ~ZipWriter();

  /// Starts an entry of at most `max_bytes`. Beyond 4 GB it uses zip64, which old readers refuse.
  void begin(const std::string& name, std::uint64_t max_bytes = 0);
  void text(std::string_view piece);
  void commit();

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
};

}  // namespace frangia
