#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace frangia {

/// A line of a DurableLog.
struct LogLine {
  std::string text;      ///< without the checksum
  bool damaged = false;  ///< the checksum does not match; the text cannot be trusted
};

/// A text file that grows by whole lines. Each line ends with its CRC-32, as " crc=1c291ca3", and
/// is on the disk when `append` returns.
///
/// Opening the file removes an incomplete last line that an interrupted `append` left.
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

  /// The lines that the file held when it was opened, damaged ones included, in their order.
  [[nodiscard]] const std::vector<LogLine>& lines() const { return lines_; }
  /// Writes a line with its checksum and returns when it is on the disk. Several threads may call
  /// it. `line` must not contain a line end.
  void append(const std::string& line);

 private:
  [[noreturn]] void fail(int error) const;
  void write(const std::string& bytes);

  std::filesystem::path path_;
  std::vector<LogLine> lines_;
  std::mutex mutex_;
  int file_;
};

}  // namespace frangia
