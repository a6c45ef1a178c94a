#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace frangia {

/// An entry of the directory of a zip archive.
struct ZipEntry {
  std::string name;           ///< that of a folder ends with a slash
  std::uint64_t bytes = 0;    ///< unpacked, as the archive states it
  std::uint64_t offset = 0;   ///< in the directory, for the reader
  std::uint64_t ordinal = 0;  ///< from 0, for the reader
};

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
  /// to 1; false when no entry has this name, in capital or small letters.
  bool read(const std::string& name,
            const std::function<void(std::string_view, double)>& consume) const;
  /// Passes an entry of `entries` to `consume` in pieces, each with its share of the entry.
  void read(const ZipEntry& entry,
            const std::function<void(std::string_view, double)>& consume) const;
  /// All entries, in the order of the archive.
  ///
  /// @errors   Error(Input) for more than `most`, and for a name of more than 4000 bytes
  [[nodiscard]] std::vector<ZipEntry> entries(std::size_t most) const;

 private:
  /// Passes the entry that minizip stands at to `consume`.
  void read_here(const std::string& name,
                 const std::function<void(std::string_view, double)>& consume) const;
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
