#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "frangia/core/durable_log.h"

namespace frangia {

/// The lines of a log file and the state of its end.
struct ParsedLog {
  std::vector<LogLine> lines;
  std::size_t size = 0;        ///< bytes to keep; an incomplete line follows them
  bool lacks_newline = false;  ///< the last line is complete except for its line end
};

/// Returns a line as it is in the file: with its checksum, without a line end.
[[nodiscard]] std::string with_checksum(const std::string& line);

/// Separates and checks the lines of a log.
[[nodiscard]] ParsedLog parse_log(const std::string& text);

}  // namespace frangia
