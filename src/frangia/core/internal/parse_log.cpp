#include "frangia/core/internal/parse_log.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "frangia/core/crc32.h"

namespace frangia {
namespace {

constexpr const char* kKey = " crc=";
constexpr std::size_t kChecksumSize = 13;  // of " crc=1c291ca3"

bool is_valid(const std::string& line) {
  return line.size() >= kChecksumSize &&
         with_checksum(line.substr(0, line.size() - kChecksumSize)) == line;
}

/// The line with its one wrong bit corrected, if that makes it valid.
std::optional<std::string> repaired_line(std::string line) {
  constexpr std::size_t kLongest = 370;  // bytes; see DurableLog
  if (line.size() < kChecksumSize || line.size() > kLongest) return std::nullopt;
  for (char& letter : line) {
    const char original = letter;
    for (unsigned bit = 0; bit < 8U; ++bit) {
      letter = static_cast<char>(static_cast<unsigned char>(original) ^ (1U << bit));
      if (is_valid(line)) return line;
    }
    letter = original;
  }
  return std::nullopt;
}

/// Collects lines and counts the repaired ones.
class LineCollector {
 public:
  explicit LineCollector(ParsedLog& log) : log_(log) {}

  /// Accepts the valid lines at the beginning of a piece, which wrong line ends may have joined.
  /// Returns where the last one ends; 0 without any.
  std::size_t accept_valid(const std::string& piece) {
    std::size_t begin = 0;
    std::size_t end = 0;
    for (std::size_t key = piece.find(kKey); key != std::string::npos;
         key = piece.find(kKey, key + 1)) {
      const std::string line = piece.substr(begin, key + kChecksumSize - begin);
      if (!is_valid(line)) continue;
      if (begin > 0) ++log_.repaired;  // the line end between two lines
      accept(line);
      end = key + kChecksumSize;
      begin = end + 1;
    }
    return end;
  }

  /// Accepts a piece of which one bit is wrong.
  bool accept_repaired(const std::string& piece) {
    const std::optional<std::string> line = repaired_line(piece);
    if (!line) return false;
    accept(*line);
    ++log_.repaired;
    return true;
  }

  void accept_damaged(const std::string& piece) { log_.lines.push_back({piece, true}); }

 private:
  void accept(const std::string& line) {
    log_.lines.push_back({line.substr(0, line.size() - kChecksumSize), false});
  }

  ParsedLog& log_;
};

}  // namespace

std::string with_checksum(const std::string& line) {
  return fmt::format("{}{}{:08x}", line, kKey, crc32(line));
}

ParsedLog parse_log(const std::string& text) {
  ParsedLog log;
  LineCollector lines(log);
  std::optional<std::string> held;  // damaged; a wrong bit may have split it from the next piece
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    const std::string piece = text.substr(begin, end - begin);
    begin = end + 1;
    if (held) {
      const bool joined = lines.accept_repaired(*held + '\n' + piece);
      if (!joined) lines.accept_damaged(*held);
      held.reset();
      if (joined) continue;
    }
    const std::size_t valid = lines.accept_valid(piece);
    if (valid > 0 && valid + 1 >= piece.size()) continue;
    const std::string rest = piece.substr(valid == 0 ? 0 : valid + 1);
    if (!lines.accept_repaired(rest)) held = rest;
  }
  if (held) lines.accept_damaged(*held);
  // The last line of a file that was cut off, or whose last line end is wrong.
  const std::size_t valid = lines.accept_valid(text.substr(begin));
  log.size = begin + valid;
  log.lacks_newline = valid > 0;
  if (log.lacks_newline) ++log.repaired;
  return log;
}

}  // namespace frangia
