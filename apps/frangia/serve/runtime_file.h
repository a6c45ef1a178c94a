#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace frangia {

/// Where a running server is found by programs of the same user: `frangia-serve.json` in
/// XDG_RUNTIME_DIR, which nobody else can read. It holds {"port": 6328, "key": "..."}.
class RuntimeFile {
 public:
  /// Writes the file with mode 0600. Does nothing without XDG_RUNTIME_DIR.
  ///
  /// @errors   Error(File) when it cannot be written
  RuntimeFile(std::uint16_t port, const std::string& key);
  RuntimeFile(const RuntimeFile&) = delete;
  RuntimeFile& operator=(const RuntimeFile&) = delete;
  RuntimeFile(RuntimeFile&&) = delete;
  RuntimeFile& operator=(RuntimeFile&&) = delete;
  /// Removes the file, unless another server has replaced it.
  ~RuntimeFile();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }  ///< empty without one

 private:
  std::filesystem::path path_;
  std::string text_;
};

/// A page that sends a browser on to a link, so that the link with its token stands on no command
/// line, which other users can read. The file has mode 0600 and is in XDG_RUNTIME_DIR, or else in a
/// folder of its own among the temporary files.
class LinkPage {
 public:
  /// @errors   Error(File) when it cannot be written
  explicit LinkPage(const std::string& link);
  LinkPage(const LinkPage&) = delete;
  LinkPage& operator=(const LinkPage&) = delete;
  LinkPage(LinkPage&&) = delete;
  LinkPage& operator=(LinkPage&&) = delete;
  ~LinkPage();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path folder_;  ///< of its own; empty without one
};

/// Asks the running server of this user for a link.
///
/// @errors   Error(Input) when no server runs; Error(Device) when it does not answer
[[nodiscard]] std::string ask_for_link();

}  // namespace frangia
