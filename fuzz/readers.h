#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace frangia {

/// One reader under test, of files or of what a network sends.
struct FuzzReader {
  std::string_view name;  ///< folder below fuzz/seeds and fuzz/findings
  std::string_view file;  ///< name that the input gets; empty for a reader of bytes
  /// Reads the input at `path`. The folder of `path` also holds the files that inputs refer to.
  void (*read)(const std::filesystem::path& path) = nullptr;
  void (*take)(std::string_view bytes) = nullptr;  ///< instead of `read`, without a file
};

/// All readers.
[[nodiscard]] std::span<const FuzzReader> fuzz_readers();

/// The reader with this name; nullptr for an unknown name.
[[nodiscard]] const FuzzReader* find_fuzz_reader(std::string_view name);

/// A temporary folder with the files that inputs refer to. It is removed at the end.
class FuzzFolder {
 public:
  FuzzFolder();
  FuzzFolder(const FuzzFolder&) = delete;
  FuzzFolder& operator=(const FuzzFolder&) = delete;
  FuzzFolder(FuzzFolder&&) = delete;
  FuzzFolder& operator=(FuzzFolder&&) = delete;
  ~FuzzFolder();

  /// Gives `bytes` to the reader, which either reads them or throws an Error. Another exception
  /// leaves this function.
  void run(const FuzzReader& reader, std::string_view bytes) const;

 private:
  std::filesystem::path path_;
};

}  // namespace frangia
