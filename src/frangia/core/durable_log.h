#pragma once

#include <filesystem>
#include <string>

namespace frangia {

/// A text file that grows by whole lines, each on the disk when `append` returns. Opening it cuts
/// off what an interrupted `append` left behind the last whole line.
///
/// errors   Error(File) that names the file, such as when the disk is full
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
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;
  std::string text_;
  int file_;
};

}  // namespace frangia
