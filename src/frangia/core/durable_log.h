#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// A text file that grows by whole lines. A line is on the disk when `append` returns. Opening the
/// file removes an incomplete last line that an interrupted `append` left.
///
/// @errors   Error(File) that names the file, for example when the disk is full
class DurableLog {
 public:
  /// Opens the file, creates it if it is missing, and reads its complete lines.
  explicit DurableLog(std::filesystem::path path);
  DurableLog(const DurableLog&) = delete;
  DurableLog& operator=(const DurableLog&) = delete;
  DurableLog(DurableLog&&) = delete;
  DurableLog& operator=(DurableLog&&) = delete;
  ~DurableLog();

  /// The lines that the file held when it was opened.
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Writes `line` and a newline, and returns when they are on the disk.
  void append(const std::string& line);

 private:
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  std::string text_;
  int file_;
};

}  // namespace frangia
