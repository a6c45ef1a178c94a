#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace frangia {

/// A zip archive that is read, entry by entry.
///
/// errors   Error(Input) that names the file: missing, no zip, damaged; an entry that unpacks to
///          more than 8 GB, or to more than 200 times its size and 64 MB
class ZipReader {
 public:
  explicit ZipReader(std::filesystem::path path);
  ZipReader(const ZipReader&) = delete;
  ZipReader& operator=(const ZipReader&) = delete;
  ZipReader(ZipReader&&) = delete;
  ZipReader& operator=(ZipReader&&) = delete;
  ~ZipReader();

  /// Hands over an entry in pieces; false when there is none of this name. Names differ by case.
  bool read(const std::string& name, const std::function<void(std::string_view)>& consume) const;

 private:
  struct Archive;
  std::filesystem::path path_;
  std::unique_ptr<Archive> archive_;
};

/// A zip archive that appears under its name when it is whole.
///
/// errors   Error(File) as AtomicFile
class ZipWriter {
 public:
  explicit ZipWriter(const std::filesystem::path& path);
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;
  ZipWriter(ZipWriter&&) = delete;
  ZipWriter& operator=(ZipWriter&&) = delete;
  ~ZipWriter();

  /// What is written next belongs to this entry, of `most_bytes` at most: beyond 4 GB it takes a
  /// form that old readers refuse.
  void begin(const std::string& name, std::uint64_t most_bytes = 0);
  void text(std::string_view piece);
  void commit();

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
};

}  // namespace frangia
