#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace frangia {

/// Writes a file that is whole under its name or not there at all, and that stays so when the power
/// goes once this has returned: temporary file, fsync, rename, fsync of the folder.
///
/// errors   Error(File) that names the file, such as when the disk is full
void write_durably(const std::filesystem::path& path, std::span<const char> bytes);

/// A file that grows by whole lines, each on the disk when `append` returns. Opening it cuts off
/// what an interrupted `append` left behind its last whole line.
///
/// errors   Error(File) that names the file
class DurableLog {
 public:
  explicit DurableLog(std::filesystem::path path);
  DurableLog(const DurableLog&) = delete;
  DurableLog& operator=(const DurableLog&) = delete;
  DurableLog(DurableLog&&) = delete;
  DurableLog& operator=(DurableLog&&) = delete;
  ~DurableLog();

  /// All that was there when it was opened: whole lines.
  [[nodiscard]] const std::string& text() const { return text_; }
  void append(const std::string& line);

 private:
  std::filesystem::path path_;
  std::string text_;
  int file_ = -1;
};

}  // namespace frangia
