#include "frangia/core/internal/parse_log.h"

#include <string_view>

#include <fmt/format.h>

#include "frangia/core/checksums.h"

namespace frangia {
namespace {

constexpr const char* kKey = " crc=";
constexpr std::size_t kChecksumSize = 13;  // of " crc=1c291ca3"

bool is_valid(const std::string& line) {
  return line.size() >= kChecksumSize &&
         with_checksum(line.substr(0, line.size() - kChecksumSize)) == line;
}

LogLine without_checksum(const std::string& line) {
  return {line.substr(0, line.size() - kChecksumSize), false};
}

}  // namespace

std::string with_checksum(const std::string& line) {
  return fmt::format("{}{}{:08x}", line, kKey, crc32(line));
}

ParsedLog parse_log(const std::string& text) {
  ParsedLog log;
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    log.lines.push_back(is_valid(line) ? without_checksum(line) : LogLine{line, true});
  }
  // What follows the last line end was cut off, unless a line lacks nothing but its end.
  const std::string last = text.substr(begin);
  const bool damaged_end = last.size() > kChecksumSize && is_valid(last.substr(0, last.size() - 1));
  log.lacks_newline = is_valid(last) || damaged_end;
  log.size = begin;
  if (!log.lacks_newline) return log;
  const std::string line = damaged_end ? last.substr(0, last.size() - 1) : last;
  log.lines.push_back(without_checksum(line));
  log.size += line.size();
  return log;
}

}  // namespace frangia
